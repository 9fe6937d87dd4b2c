#pragma once

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "property_tests/generators/numbers.h"
#include "slam/geometry/pose.h"

namespace slam {

using generators::AnyInt;

/// Draws inside a property. Reals are built from integers at full size, because rapidcheck's
/// own doubles are useless for geometry and its ranges shrink with the size parameter.
inline double AnyReal(double low, double high) {
  constexpr std::int64_t kSteps = std::int64_t{1} << 52;
  const std::int64_t k = *rc::gen::resize(100, rc::gen::inRange<std::int64_t>(0, kSteps + 1));
  return low + (high - low) * (static_cast<double>(k) / static_cast<double>(kSteps));
}

inline Eigen::Vector3d AnyPoint(double half_m) {
  return {AnyReal(-half_m, half_m), AnyReal(-half_m, half_m), AnyReal(-half_m, half_m)};
}

/// Unit vector: mostly anywhere, often an axis, or an axis tilted by 1e-12 to 1e-3.
inline Eigen::Vector3d AnyUnit() {
  const int kind = AnyInt(0, 9);
  if (kind < 8) {
    const double z = AnyReal(-1, 1), a = AnyReal(-M_PI, M_PI);
    const double s = std::sqrt(std::max(0.0, 1 - z * z));
    return Eigen::Vector3d(s * std::cos(a), s * std::sin(a), z).normalized();
  }
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  n[AnyInt(0, 2)] = AnyInt(0, 1) ? 1.0 : -1.0;
  if (kind == 9) n += std::pow(10.0, AnyReal(-12, -3)) * AnyPoint(1);
  return n.normalized();
}

/// Angle in [0, pi]: anywhere, tiny, nearly pi, or exactly 0.
inline double AnyAngle() {
  const int kind = AnyInt(0, 8);
  if (kind < 4) return AnyReal(0, M_PI);
  if (kind < 6) return std::pow(10.0, AnyReal(-12, -2));
  if (kind < 8) return M_PI - std::pow(10.0, AnyReal(-6, -2));
  return 0.0;
}

inline Pose AnyPose(double half_m) {
  const Eigen::Vector3d axis = AnyUnit();
  return {ExpSo3(AnyAngle() * axis), AnyPoint(half_m)};
}

/// A small motion: at most these.
inline Pose AnyMotion(double max_rad, double max_m) {
  const Eigen::Vector3d axis = AnyUnit(), direction = AnyUnit();
  return {ExpSo3(AnyReal(0, max_rad) * axis), AnyReal(0, max_m) * direction};
}

/// Standard normal draw (sum of twelve uniforms would clip: Box-Muller).
inline double AnyNormal() {
  const double u = AnyReal(1e-12, 1), v = AnyReal(0, 1);
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * M_PI * v);
}

}  // namespace slam
