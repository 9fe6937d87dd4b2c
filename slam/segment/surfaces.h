#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/join_config.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// A label's pixels and the plane fitted to them.
struct Surface {
  PlaneSums sums;
  LabelPlane plane;
  bool bent = false;  ///< its parts may be off the plane by as much as the sensor bends
};

/// How far what belongs to a bent surface may be off its plane, sigmas; 0 for one that is not.
double BendSigmas(const Surface& surface, const JoinConfig& config);

/// Squared distance of two planes over the pixels of the smaller surface, over what noise and
/// the bend allow there; below 1: they may be one plane.
double SurfaceGap(const Surface& a, const Surface& b, const DepthNoise& noise,
                  const JoinConfig& config);

}  // namespace slam
