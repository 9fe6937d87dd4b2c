#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/geometry/plane.h"

namespace slam {

/// A plane of the map where it should be seen in a frame.
struct ExpectedPlane {
  Plane pi_c;  ///< facing the camera
  /// Convex, in order, recorded image; empty where it is not known or not all in front of the
  /// camera. Nothing says that all of it is in the image or in view.
  std::vector<Eigen::Vector2d> outline_px;
  double margin_px = 0.0;  ///< the outline may be off by so much
};

}  // namespace slam
