#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/joining/join_config.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

/// A label's pixels and the plane fitted to them.
struct Surface {
  PlaneSums sums;
  LabelPlane plane;
  bool bent = false;  ///< its parts may be off the plane by as much as the sensor bends
};

/// How far what belongs to a bent surface may be off its plane, sigmas; 0 for one that is not.
double BendSigmas(const Surface& surface, const JoinConfig& config);

/// What the sensor is seen to bend, root mean square, as a part of the depth: by how much more than
/// noise half of what lies on large surfaces is off their planes. At most `max_seen_ratio` times
/// what the configuration says; that, where no surface is large.
double SeenBend(const std::vector<PlaneSums>& surfaces, const DepthNoise& noise,
                const JoinConfig& config);

/// Chi-square (3 degrees of freedom) of two parts being one plane: the error that a plane for both
/// adds to those of a plane for each, over what noise and the bend explain. Infinite where there
/// is no such plane.
double UnionChi2(const PlaneSums& a, const PlaneSums& b, const DepthNoise& noise,
                 const JoinConfig& config);

/// The same for parts that no border tells of: -2 log likelihood, up to a constant. That they agree says
/// less, the less the plane of the larger tells where the smaller should lie; so the logarithm of
/// that standard deviation, in sigmas of a pixel, is added for each parameter of a plane.
double HiddenUnionCost(const PlaneSums& a, const PlaneSums& b, const DepthNoise& noise,
                       const JoinConfig& config);

}  // namespace slam
