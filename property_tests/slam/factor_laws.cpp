#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/planes.h"
#include "slam/pose/factors/box.h"
#include "slam/pose/factors/parallel.h"
#include "slam/pose/factors/perpendicular.h"
#include "slam/pose/factors/plane.h"
#include "slam/pose/factors/point.h"
#include "slam/pose/factors/point_plane.h"
#include "slam/pose/factors/vertex.h"
#include "tests/support/numeric_jacobian.h"

namespace slam {
namespace {

// The five-point difference reaches about 1e-9 on residuals of a few hundred pixels a radian.
constexpr double kJacobianTolerance = 1e-6;
// A flipped sign changes a Jacobian by twice its size: far beyond any difference error.
constexpr double kClearlyWrong = 1e-3;
constexpr double kBf = 40.0;

/// A small motion of a camera that still sees what it saw.
Pose Nearby(const Pose& T_cw) { return AnyMotion(0.08, 0.05) * T_cw; }

template <int kRows, typename Factor>
void CheckJacobian(const Pose& T_cw, const Factor& factor) {
  const Linearised<kRows> at = factor(T_cw);
  RC_ASSERT(at.valid);
  const auto numeric = NumericJacobian<kRows>(T_cw, [&](const Pose& T) { return factor(T).r; });
  RC_ASSERT(JacobianError(at.J, numeric) < kJacobianTolerance);
  // The check can fail: one column with a flipped sign is noticed.
  Eigen::Index row = 0, column = 0;
  at.J.cwiseAbs().maxCoeff(&row, &column);
  auto flipped = at.J;
  flipped.col(column) *= -1;
  RC_ASSERT(JacobianError(flipped, numeric) > kClearlyWrong);
}

RC_GTEST_PROP(PointFactorEq14, VanishesAtTruthAndHasItsJacobian, ()) {
  const Camera camera;
  const Pose T_cw = AnyPose(3);
  const double z = AnyReal(0.5, 5);
  const Eigen::Vector2d u(AnyReal(0, 639), AnyReal(0, 479));
  PointConstraint c;
  c.p_w = Inverse(T_cw) * camera.Backproject(u, z);
  c.u_px = u;
  c.sigma_px = AnyReal(0.5, 4);
  if (AnyInt(0, 1)) c.depth_m = z, c.depth_sigma_m = AnyReal(0.001, 0.1);
  RC_ASSERT(PointFactor(c, T_cw, camera).r.norm() < 1e-9);
  CheckJacobian<3>(Nearby(T_cw), [&](const Pose& T) { return PointFactor(c, T, camera); });
}

RC_GTEST_PROP(PlaneFactorEq16, VanishesAtTruthAndHasItsJacobianAtEveryOrientation, ()) {
  const Pose T_cw = AnyPose(3);
  const SeenPlane seen = AnySeenPlane();
  PlaneConstraint c;
  c.pi_c = seen.pi_c;
  c.centroid_c = seen.point_c;
  c.pi_w = Transform(Inverse(T_cw), seen.pi_c);
  RC_ASSERT(PlaneFactor(c, T_cw).r.norm() < 1e-12 * (1 + T_cw.t.norm() * 10));
  const Pose off = AnyMotion(1.5, 0.5) * T_cw;
  CheckJacobian<4>(off, [&](const Pose& T) { return PlaneFactor(c, T); });
}

RC_GTEST_PROP(PlaneFactorEq16, IsContinuousInTheMeasuredPlaneAcrossEveryChartBorder, ()) {
  const Pose T_cw = AnyPose(3);
  const SeenPlane seen = AnySeenPlane();
  PlaneConstraint c;
  c.pi_w = Transform(Inverse(Nearby(Pose{}) * T_cw), seen.pi_c);
  c.centroid_c = seen.point_c;
  const double step = std::pow(10.0, AnyReal(-12, -3));
  const Eigen::Vector3d n_2 = (seen.pi_c.n + step * AnyPoint(1)).normalized();
  c.pi_c = seen.pi_c;
  const Linearised<4> one = PlaneFactor(c, T_cw);
  c.pi_c = {n_2, -n_2.dot(seen.point_c)};
  const Linearised<4> two = PlaneFactor(c, T_cw);
  RC_ASSERT((one.r - two.r).norm() < 5 * step + 1e-12);
  RC_ASSERT((one.J - two.J).norm() < 50 * step + 1e-9);
}

RC_GTEST_PROP(PlaneFactorEq16, DoesNotDependOnWhereTheWorldLies, ()) {
  const Pose T_cw = AnyPose(3), T_vw = AnyPose(10);
  const SeenPlane seen = AnySeenPlane();
  PlaneConstraint c;
  c.pi_c = seen.pi_c;
  c.centroid_c = seen.point_c;
  c.pi_w = Transform(Inverse(Nearby(T_cw)), seen.pi_c);
  const Linearised<4> here = PlaneFactor(c, T_cw);
  c.pi_w = Transform(T_vw, c.pi_w);
  const Linearised<4> there = PlaneFactor(c, T_cw * Inverse(T_vw));
  RC_ASSERT((here.r - there.r).norm() < 1e-11);
  RC_ASSERT((here.J - there.J).norm() < 1e-10);
}

RC_GTEST_PROP(BoxFactorEq17, VanishesAtTruthAndHasItsJacobianWithAndWithoutDistortion, ()) {
  const Camera camera = AnyInt(0, 1) ? TumCamera("tum1") : Camera{};
  const Pose T_cw = AnyPose(3);
  BoxConstraint c;
  Box box;
  // Corners at distinct sides, so that the extreme of each side is one corner also nearby.
  const double z = AnyReal(0.8, 2);
  for (const Eigen::Vector2d& u : {Eigen::Vector2d(200, 230), Eigen::Vector2d(330, 120),
                                   Eigen::Vector2d(470, 260), Eigen::Vector2d(310, 380)}) {
    const Eigen::Vector3d x_c = camera.Backproject(u, z);
    c.corners_w.push_back(Inverse(T_cw) * x_c);
    box.Include(camera.ProjectDistorted(x_c));
  }
  c.box_obs_px = box;
  RC_ASSERT(BoxFactor(c, T_cw, camera).r.norm() < 1e-8);
  CheckJacobian<4>(Nearby(T_cw), [&](const Pose& T) { return BoxFactor(c, T, camera); });
}

RC_GTEST_PROP(PointPlaneFactorEq18, VanishesAtTruthAndHasItsJacobian, ()) {
  const Pose T_cw = AnyPose(3);
  const SeenPlane seen = AnySeenPlane();
  const PointPlaneConstraint c{Inverse(T_cw) * seen.point_c, seen.pi_c, 0.01};
  RC_ASSERT(std::abs(PointPlaneFactor(c, T_cw).r[0]) < 1e-12 * (1 + T_cw.t.norm() * 10));
  CheckJacobian<1>(AnyMotion(1, 1) * T_cw,
                   [&](const Pose& T) { return PointPlaneFactor(c, T); });
}

RC_GTEST_PROP(VertexFactor, VanishesAtTruthAndHasItsJacobian, ()) {
  const Pose T_cw = AnyPose(3);
  const SeenPlane seen = AnySeenPlane();
  const VertexConstraint c{Inverse(T_cw) * seen.point_c, seen.point_c,
                           100 * TangentBasis(seen.pi_c.n).transpose()};
  RC_ASSERT(VertexFactor(c, T_cw).r.norm() < 1e-10 * (1 + T_cw.t.norm() * 10));
  CheckJacobian<2>(AnyMotion(1, 1) * T_cw, [&](const Pose& T) { return VertexFactor(c, T); });
}

// What lies across the plane is the plane's to tell.
RC_GTEST_PROP(VertexFactor, SaysNothingAboutStepsAcrossItsPlane, ()) {
  const Pose T_cw = AnyPose(1);
  const SeenPlane seen = AnySeenPlane();
  const VertexConstraint c{Inverse(T_cw) * seen.point_c, seen.point_c,
                           100 * TangentBasis(seen.pi_c.n).transpose()};
  const Pose stepped{T_cw.R, T_cw.t + AnyReal(-1, 1) * seen.pi_c.n};
  RC_ASSERT(VertexFactor(c, stepped).r.norm() < 1e-9);
}

RC_GTEST_PROP(ParallelFactorEq19, VanishesAtTruthAndHasItsJacobian, ()) {
  const Pose T_cw = AnyPose(3);
  const Eigen::Vector3d n_c = AnyUnit();
  const double sign = AnyInt(0, 1) ? 1.0 : -1.0;
  const DirectionConstraint c{sign * T_cw.R.transpose() * n_c, n_c, 0.02};
  RC_ASSERT(ParallelFactor(c, T_cw).r.norm() < 1e-13);
  CheckJacobian<3>(AnyMotion(1, 1) * T_cw, [&](const Pose& T) { return ParallelFactor(c, T); });
}

RC_GTEST_PROP(PerpendicularFactorEq20, VanishesAtTruthAndHasItsJacobian, ()) {
  const Pose T_cw = AnyPose(3);
  const Eigen::Vector3d n_c = AnyUnit();
  const double a = AnyReal(-M_PI, M_PI);
  const Eigen::Vector3d other_c = TangentBasis(n_c) * Eigen::Vector2d(std::cos(a), std::sin(a));
  const DirectionConstraint c{T_cw.R.transpose() * other_c, n_c, 0.02};
  RC_ASSERT(std::abs(PerpendicularFactor(c, T_cw).r[0]) < 1e-13);
  CheckJacobian<1>(AnyMotion(0.5, 1) * T_cw,
                   [&](const Pose& T) { return PerpendicularFactor(c, T); });
}

RC_GTEST_PROP(PerpendicularFactorEq20, SaysNothingAboutTurnsThatKeepTheRightAngle, ()) {
  const Eigen::Vector3d n_c = AnyUnit();
  const double a = AnyReal(-M_PI, M_PI);
  const Eigen::Vector3d n_w = TangentBasis(n_c) * Eigen::Vector2d(std::cos(a), std::sin(a));
  const DirectionConstraint c{n_w, n_c, 0.02};
  const Pose about_c{ExpSo3(AnyReal(-3, 3) * n_c), AnyPoint(1)};
  RC_ASSERT(std::abs(PerpendicularFactor(c, about_c).r[0]) < 1e-12);
}

}  // namespace
}  // namespace slam
