#pragma once

namespace slam {

/// Whether something measured in front hides a point of the map: it lies farther behind the
/// measured depth than sensor and pose get wrong, and less than the height of what hides
/// (balances the two). Planes that lie closer are told apart by their labels, not here.
/// @param depth_m  measured at the point's pixel, planar z; > 0
/// @param z_m      the point's own, planar z
inline bool IsHidden(double depth_m, double z_m) {
  constexpr double kMargin_m = 0.02;
  constexpr double kMarginShare = 0.02;  // of the distance
  return depth_m < z_m - kMargin_m - kMarginShare * z_m;
}

}  // namespace slam
