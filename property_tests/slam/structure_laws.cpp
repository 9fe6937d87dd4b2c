#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/planes.h"
#include "slam/pose/factors/rotation.h"
#include "slam/structure/manhattan_world.h"
#include "slam/structure/rotation_from_axes.h"
#include "slam/structure/supposed_planes.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/numeric_jacobian.h"

namespace slam {
namespace {

Eigen::Matrix3d AnyRotation() { return AnyPose(1).R; }

RotationConstraint AnyMeasured(const Eigen::Matrix3d& R_cw) {
  RotationConstraint c;
  c.R_cw = R_cw;
  for (int i = 0; i < 3; ++i) c.sqrt_information.row(i) = AnyReal(0, 100) * AnyUnit();
  return c;
}

std::vector<AxisObservation> Seen(const Eigen::Matrix3d& R_cw, int axes) {
  const Eigen::Matrix3d axes_w = AnyRotation();
  std::vector<AxisObservation> seen;
  for (int k = 0; k < axes; ++k)
    seen.push_back({axes_w.col(k), R_cw * axes_w.col(k), AnyReal(0.001, 0.05)});
  return seen;
}

double AngleBetween(const Eigen::Matrix3d& R_1, const Eigen::Matrix3d& R_2) {
  return LogSo3(R_1 * R_2.transpose()).norm();
}

RC_GTEST_PROP(RotationFactor, VanishesAtTruthAndHasItsJacobian, ()) {
  const Pose T_cw = AnyPose(3);
  const RotationConstraint c = AnyMeasured(T_cw.R);
  RC_ASSERT(RotationFactor(c, T_cw).r.norm() < 1e-9);
  const Pose off = AnyMotion(1.5, 0.5) * T_cw;
  const auto factor = [&](const Pose& T) { return RotationFactor(c, T).r; };
  const Linearised<3> at = RotationFactor(c, off);
  RC_ASSERT(at.valid);
  const auto numeric = NumericJacobian<3>(off, factor);
  RC_ASSERT(JacobianError(at.J, numeric) < 1e-6);
  RC_ASSERT(at.J.leftCols<3>().isZero());
}

RC_GTEST_PROP(RotationFactor, DoesNotDependOnWhereTheWorldLies, ()) {
  const Pose T_cw = AnyPose(3), T_vw = AnyPose(10);
  RotationConstraint c = AnyMeasured(AnyMotion(1, 1).R * T_cw.R);
  const Linearised<3> here = RotationFactor(c, T_cw);
  c.R_cw = c.R_cw * T_vw.R.transpose();
  const Linearised<3> there = RotationFactor(c, T_cw * Inverse(T_vw));
  RC_ASSERT((here.r - there.r).norm() < 1e-9);
  RC_ASSERT((here.J - there.J).norm() < 1e-8);
}

RC_GTEST_PROP(RotationFromAxes, IsExactForTwoOrThreeAxes, ()) {
  const Eigen::Matrix3d R_cw = AnyRotation();
  const auto found = RotationFromAxes(Seen(R_cw, AnyInt(2, 3)), AnyMotion(0.3, 1).R * R_cw);
  RC_ASSERT(found.has_value());
  RC_ASSERT(AngleBetween(found->R_cw, R_cw) < 1e-8);
  RC_ASSERT((found->sqrt_information.transpose() * found->sqrt_information).determinant() > 0);
}

RC_GTEST_PROP(RotationFromAxes, LeavesTheTurnAboutASingleAxisFree, ()) {
  const Eigen::Matrix3d R_cw = AnyRotation(), guess = AnyMotion(0.3, 1).R * R_cw;
  const auto seen = Seen(R_cw, 1);
  const auto found = RotationFromAxes(seen, guess);
  RC_ASSERT(found.has_value());
  RC_ASSERT((found->R_cw * seen[0].axis_w - seen[0].n_c).norm() < 1e-8);
  RC_ASSERT((found->sqrt_information * seen[0].n_c).norm() < 1e-6 / seen[0].sigma_rad);
  // The shortest way there, so that nothing is said of the turn about the axis ...
  const double shortest = Angle(guess * seen[0].axis_w, seen[0].n_c);
  RC_ASSERT(std::abs(AngleBetween(found->R_cw, guess) - shortest) < 1e-8);
  // ... by the factor either, however far.
  const Pose turned{ExpSo3(AnyReal(-2, 2) * seen[0].n_c) * found->R_cw, {}};
  RC_ASSERT(RotationFactor(*found, turned).r.norm() < 1e-5 / seen[0].sigma_rad);
}

RC_GTEST_PROP(RotationFromAxes, IsOffByWhatItsInformationSays, ()) {
  const Eigen::Matrix3d R_cw = AnyRotation();
  std::vector<AxisObservation> seen = Seen(R_cw, 3);
  for (AxisObservation& o : seen)
    o.n_c =
        (o.n_c + o.sigma_rad * TangentBasis(o.n_c) * Eigen::Vector2d(AnyNormal(), AnyNormal()))
            .normalized();
  const auto found = RotationFromAxes(seen, R_cw);
  RC_ASSERT(found.has_value());
  const double sigmas = RotationFactor(*found, {R_cw, {}}).r.norm();
  RC_ASSERT(sigmas < 7);  // chi with three degrees of freedom: once in 10^10
}

RC_GTEST_PROP(ManhattanAxes, TurnWithTheWorld, ()) {
  const Eigen::Matrix3d R_wm = AnyRotation(), R_vw = AnyRotation();
  Map here, there;
  for (int k = 0; k < 3; ++k) {
    MapPlane plane;
    plane.area_m2 = AnyReal(0.5, 3);
    plane.observations = 10;
    plane.pi_w.n = AnyMotion(0.02, 1).R * R_wm.col(k);
    AddLandmark(here, plane);
    plane.pi_w.n = R_vw * plane.pi_w.n;
    AddLandmark(there, plane);
  }
  const auto in_w = FindManhattanAxes(here.planes, {}),
             in_v = FindManhattanAxes(there.planes, {});
  RC_ASSERT(in_w.has_value() && in_v.has_value());
  RC_ASSERT(AngleBetween(*in_v, R_vw * *in_w) < 1e-7);
}

RC_GTEST_PROP(SupposedPlanes, HoldTheirEdgeAtARightAngleAndFaceAway, ()) {
  const SeenPlane seen = AnySeenPlane();
  FramePlane plane;
  plane.pi_c = seen.pi_c;
  plane.centroid_c = seen.point_c;
  const Eigen::Matrix<double, 3, 2> tangents = TangentBasis(seen.pi_c.n);
  const double a = AnyReal(-M_PI, M_PI);
  const Eigen::Vector3d along = tangents * Eigen::Vector2d(std::cos(a), std::sin(a));
  const Eigen::Vector3d outward = seen.pi_c.n.cross(along);
  plane.lines_c = {{seen.point_c + 0.2 * outward + AnyReal(-1, 1) * along, along}};
  const auto supposed = SupposePlanes(plane, SupposedConfig{});
  RC_ASSERT(supposed.size() == 1u);
  const Plane& pi_c = supposed[0].pi_c;
  RC_ASSERT(std::abs(pi_c.n.dot(plane.pi_c.n)) < 1e-12);
  RC_ASSERT(std::abs(SignedDistance(pi_c, plane.lines_c[0].P)) < 1e-9);
  RC_ASSERT(std::abs(SignedDistance(pi_c, plane.lines_c[0].P + along)) < 1e-9);
  RC_ASSERT(std::abs(SignedDistance(pi_c, plane.centroid_c) + 0.2) < 1e-9);
}

}  // namespace
}  // namespace slam
