#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/planes.h"
#include "slam/pose/factors/plane.h"

namespace slam {
namespace {

// Worst value of straightforward code: 2.7e-14.
RC_GTEST_PROP(PlaneTransformEq15, TransformKeepsTheDistanceOfEveryPoint, ()) {
  const Pose T_cw = AnyPose(10);
  const Plane pi_w = AnyPlane(10);
  const Eigen::Vector3d x_w = AnyPoint(20);
  const double before = SignedDistance(pi_w, x_w);
  const double after = SignedDistance(Transform(T_cw, pi_w), T_cw * x_w);
  RC_ASSERT(std::abs(before - after) < 1e-12 * (1 + x_w.norm() + T_cw.t.norm()));
}

RC_GTEST_PROP(PlaneTransformEq15, TransformFollowsTheProductOfPoses, ()) {
  const Pose A = AnyPose(10), B = AnyPose(10);
  const Plane pi = AnyPlane(10);
  const Plane once = Transform(A * B, pi), twice = Transform(A, Transform(B, pi));
  const double bound = 1e-12 * (1 + A.t.norm() + B.t.norm());
  RC_ASSERT((once.n - twice.n).norm() < bound);
  RC_ASSERT(std::abs(once.d - twice.d) < bound);
}

RC_GTEST_PROP(PlaneOrientation, FacingTheOriginIsIdempotentAndForgetsTheSign, ()) {
  const Plane pi = AnyPlane(10);
  const Plane once = FacingOrigin(pi), twice = FacingOrigin(once);
  RC_ASSERT(once.d >= 0);
  RC_ASSERT(once.n == twice.n && once.d == twice.d);
  if (pi.d != 0) {
    const Plane other = FacingOrigin({-pi.n, -pi.d});
    RC_ASSERT(other.n == once.n && other.d == once.d);
  }
}

RC_GTEST_PROP(PlaneTangent, BasisIsOrthonormalAndRightHanded, ()) {
  const Eigen::Vector3d n = AnyUnit();
  const Eigen::Matrix<double, 3, 2> E = TangentBasis(n);
  Eigen::Matrix3d M;
  M << E, n;
  RC_ASSERT((M.transpose() * M - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < 1e-14);
  RC_ASSERT(std::abs(M.determinant() - 1) < 1e-14);
}

RC_GTEST_PROP(PlaneResidualEq16, TurnIsAsLongAsTheAngleBetweenTheNormalsEverywhere, ()) {
  const Eigen::Vector3d n_1 = AnyUnit();
  const Eigen::Vector3d axis =
      (TangentBasis(n_1) * Eigen::Vector2d(1, AnyReal(-1, 1))).normalized();
  const double angle = AnyInt(0, 1) ? std::pow(10.0, AnyReal(-9, 0)) : AnyReal(0, 3.1);
  const Eigen::Vector3d n_2 = (ExpSo3(angle * axis) * n_1).normalized();
  const NormalDifference turn = TurnBetween(n_1, n_2);
  RC_ASSERT(turn.valid);
  RC_ASSERT(std::abs(turn.r.norm() - angle) < 1e-9 * angle + 1e-15);
  // The turn takes the one to the other: retract and local are inverse.
  RC_ASSERT((ExpSo3(turn.r) * n_1 - n_2).norm() < 1e-13);
}

RC_GTEST_PROP(PlaneResidualEq16, OppositeNormalsAreRefusedNotWrong, ()) {
  const Eigen::Vector3d n = AnyUnit();
  RC_ASSERT(!TurnBetween(n, -n).valid);
  RC_ASSERT(TurnBetween(n, -n).r.allFinite());
}

RC_GTEST_PROP(PlaneResidualEq16, TurnsOfNearlyHalfACircleAreRightOrRefused, ()) {
  const Eigen::Vector3d n_1 = AnyUnit();
  const double a = AnyReal(-M_PI, M_PI), short_of_pi = std::pow(10.0, AnyReal(-9, -3));
  const Eigen::Vector3d axis = TangentBasis(n_1) * Eigen::Vector2d(std::cos(a), std::sin(a));
  const Eigen::Vector3d n_2 = (ExpSo3((M_PI - short_of_pi) * axis) * n_1).normalized();
  const NormalDifference turn = TurnBetween(n_1, n_2);
  RC_ASSERT(turn.r.allFinite() && turn.dr_dn2.allFinite());
  if (short_of_pi > 1.001e-6) RC_ASSERT(turn.valid);
  if (short_of_pi < 0.999e-6) RC_ASSERT(!turn.valid);
  if (!turn.valid) return;
  RC_ASSERT(std::abs(turn.r.norm() - (M_PI - short_of_pi)) < 1e-13);
  // The axis is known as the sine of the turn is to round-off.
  RC_ASSERT((turn.r.normalized() - axis).norm() < 1e-14 / short_of_pi);
}

RC_GTEST_PROP(PlaneTransformEq15, TransformIsTheInverseTransposeOfThePose, ()) {
  const Pose T_cw = AnyPose(10);
  const Plane pi_w = AnyPlane(10);
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = T_cw.R;
  M.topRightCorner<3, 1>() = T_cw.t;
  Eigen::Vector4d as_vector;
  as_vector << pi_w.n, pi_w.d;
  const Plane pi_c = Transform(T_cw, pi_w);
  Eigen::Vector4d found;
  found << pi_c.n, pi_c.d;
  // M^T pi_c = pi_w, without an inverse.
  RC_ASSERT((M.transpose() * found - as_vector).norm() < 1e-12 * (1 + T_cw.t.norm()));
}

}  // namespace
}  // namespace slam
