#pragma once

#include <cmath>

#include "slam/model/frame_plane.h"

namespace slam {

/// Standard deviation of a measured normal, radians: its fit and what the sensor bends.
inline double NormalSigma(const FramePlane& plane) {
  return std::hypot(plane.angle_sigma_rad, plane.bend_angle_sigma_rad);
}

}  // namespace slam
