#pragma once

namespace slam {

/// How far behind what is measured a point of the map must lie to be hidden by it: more than sensor and
/// pose get wrong, and less than the height of what hides (balances the two). Planes that lie closer
/// are told apart by their labels, not here.
inline double HidingMargin_m(double z_m) {
  constexpr double kMargin_m = 0.02;
  constexpr double kMarginShare = 0.02;  // of the distance
  return kMargin_m + kMarginShare * z_m;
}

/// Whether something measured in front hides a point of the map.
/// @param depth_m  measured at the point's pixel, planar z; > 0
/// @param z_m      the point's own, planar z
inline bool IsHidden(double depth_m, double z_m) { return depth_m < z_m - HidingMargin_m(z_m); }

}  // namespace slam
