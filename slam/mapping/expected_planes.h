#pragma once

#include <vector>

#include "slam/geometry/camera.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/model/map.h"
#include "slam/segment/expected_plane.h"

namespace slam {

/// The landmark planes whose fronts a camera at T_cw looks at, in order of their ids, with the
/// outlines of those that are seen: the four corners of a known face, the hull of the cloud of
/// another. Planes that are surely in view by their outline or cannot be told: what hides them
/// is not asked. Only planes that were seen often enough to be fused (min_fused_observations).
std::vector<ExpectedPlane> ExpectPlanes(const Map& map, const Pose& T_cw, const Camera& camera,
                                        const PlaneMapConfig& config);

}  // namespace slam
