#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "property_tests/generators/poses.h"
#include "slam/faces/common_perpendicular.h"

namespace slam {
namespace {

constexpr double kReach_m = 5.0;  // coordinates of the lines' points
constexpr double kMinAngle_rad = 1e-4;

/// Two lines at an angle of 10^U(-3, 0.19) rad, 0 to 0.5 m apart.
struct LinePair {
  Line i, j;
  double angle_rad, gap_m;
};

LinePair AnyLines(double low_exponent, double high_exponent) {
  const double angle = std::pow(10.0, AnyReal(low_exponent, high_exponent));
  const double gap = AnyInt(0, 4) == 0 ? 0.0 : AnyReal(0.0, 0.5);
  const Pose T = AnyPose(kReach_m);
  const Eigen::Vector3d V(std::cos(angle), std::sin(angle), 0.0);
  const Eigen::Vector3d along_i(AnyReal(-kReach_m, kReach_m), 0, 0);
  const Eigen::Vector3d along_j = AnyReal(-kReach_m, kReach_m) * V;
  return {{T * along_i, T.R.col(0)},
          {T * Eigen::Vector3d(along_j + Eigen::Vector3d(0, 0, gap)), T.R * V},
          angle,
          gap};
}

/// Error of a foot for lines of size L at this angle; measured 1.6e-15 / angle^2, margin 6 and
/// the size of the coordinates.
double FootBound_m(const LinePair& lines) {
  const double size = 1.0 + lines.i.P.norm() + lines.j.P.norm();
  return 1e-14 * size / std::pow(std::sin(lines.angle_rad), 2);
}

RC_GTEST_PROP(CommonPerpendicularEq5, FeetLieOnTheirLinesAndNoPointsAreCloser, ()) {
  const LinePair lines = AnyLines(-3.0, 0.19);
  const PerpendicularFeet feet = CommonPerpendicular(lines.i, lines.j, kMinAngle_rad).value();
  const double bound = FootBound_m(lines);
  RC_ASSERT((feet.on_i - lines.i.P).cross(lines.i.V).norm() < bound);
  RC_ASSERT((feet.on_j - lines.j.P).cross(lines.j.V).norm() < bound);
  const double distance = (feet.on_i - feet.on_j).norm();
  RC_ASSERT(std::abs(distance - lines.gap_m) < bound * std::sin(lines.angle_rad) + 1e-12);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector3d a = feet.on_i + AnyReal(-1, 1) * lines.i.V;
    const Eigen::Vector3d b = feet.on_j + AnyReal(-1, 1) * lines.j.V;
    RC_ASSERT((a - b).norm() > distance - bound);
  }
}

RC_GTEST_PROP(CommonPerpendicularEq5, SwappingTheLinesSwapsTheFeet, ()) {
  const LinePair lines = AnyLines(-3.0, 0.19);
  const auto ij = CommonPerpendicular(lines.i, lines.j, kMinAngle_rad).value();
  const auto ji = CommonPerpendicular(lines.j, lines.i, kMinAngle_rad).value();
  RC_ASSERT((ij.on_i - ji.on_j).norm() < 2 * FootBound_m(lines));
  RC_ASSERT((ij.on_j - ji.on_i).norm() < 2 * FootBound_m(lines));
}

RC_GTEST_PROP(CommonPerpendicularEq5, MovesWithTheLines, ()) {
  const LinePair lines = AnyLines(-3.0, 0.19);
  const Pose T = AnyPose(kReach_m);
  const auto moved = [&](const Line& L) { return Line{T * L.P, T.R * L.V}; };
  const auto before = CommonPerpendicular(lines.i, lines.j, kMinAngle_rad).value();
  const auto after = CommonPerpendicular(moved(lines.i), moved(lines.j), kMinAngle_rad).value();
  const double bound = 10 * (1.0 + T.t.norm()) * FootBound_m(lines);
  RC_ASSERT((T * before.on_i - after.on_i).norm() < bound);
  RC_ASSERT((T * before.on_j - after.on_j).norm() < bound);
}

RC_GTEST_PROP(CommonPerpendicularEq5, LengthsOfTheDirectionsDoNotMatter, ()) {
  const LinePair lines = AnyLines(-3.0, 0.19);
  const auto scaled = [](const Line& L) {
    return Line{L.P, std::pow(10.0, AnyReal(-3, 3)) * L.V};
  };
  const auto unit = CommonPerpendicular(lines.i, lines.j, kMinAngle_rad).value();
  const auto other =
      CommonPerpendicular(scaled(lines.i), scaled(lines.j), kMinAngle_rad).value();
  RC_ASSERT((unit.on_i - other.on_i).norm() < 2 * FootBound_m(lines));
  RC_ASSERT((unit.on_j - other.on_j).norm() < 2 * FootBound_m(lines));
}

RC_GTEST_PROP(CommonPerpendicularEq5, NearlyParallelLinesHaveNoFeet, ()) {
  const LinePair lines = AnyLines(-12.0, -3.0);
  const auto result = CommonPerpendicular(lines.i, lines.j, kMinAngle_rad);
  if (lines.angle_rad < 0.99 * kMinAngle_rad) RC_ASSERT(!result.has_value());
  if (lines.angle_rad > 1.01 * kMinAngle_rad) RC_ASSERT(result.has_value());
  if (result) RC_ASSERT(result.value().on_i.allFinite() && result.value().on_j.allFinite());
}

}  // namespace
}  // namespace slam
