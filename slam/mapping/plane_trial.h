#pragma once

#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// A frame plane that is measured well enough to start a candidate, or to speak for one.
bool IsGood(const FramePlane& plane, const PlaneMapConfig& config);

/// A candidate has shown itself in enough frames, and large enough in all of them together.
bool HasProvenItself(const MapPlane& candidate, const PlaneMapConfig& config);

/// Erases candidates that were missed too often or turn out to lie on an unstructured object,
/// as the frame sees them at frame.T_cw. A candidate misses every frame after its first that
/// does not show it, in view or not, so their number is bounded by what a few frames can show.
void EraseFailedCandidates(const Frame& frame, const Camera& camera,
                           const PlaneMapConfig& config, Map& map);

}  // namespace slam
