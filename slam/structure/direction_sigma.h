#pragma once

#include <cmath>

#include "slam/model/frame_plane.h"

namespace slam {

/// Standard deviation of a measured normal, radians: its fit, what the sensor bends, and a floor
/// (plane_constraints: plane_angle_floor_deg).
inline double NormalSigma(const FramePlane& plane, double floor_rad) {
  return std::hypot(plane.angle_sigma_rad, plane.bend_angle_sigma_rad, floor_rad);
}

}  // namespace slam
