#pragma once

#include <Eigen/Core>

#include "slam/geometry/plane.h"
#include "slam/model/plane_estimate.h"

namespace slam {

/// A plane that nobody measured: at a right angle to a landmark, through a straight edge of it.
struct SupposedPlane {
  Plane pi_w;  ///< faces away from the landmark's patch
  PlaneEstimate estimate;
  int observations = 0;
  int first_frame = 0, last_frame = 0;
};

}  // namespace slam
