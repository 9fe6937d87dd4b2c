#pragma once

#include "slam/associate/association_config.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Takes one tracked frame into the map's planes, at the final frame.T_cw.
///
/// A matched plane is updated: parameters (as information), class belief, thinned cloud and
/// boundary, outline, corners, covisibility, the map points on it. A good plane that
/// shows nothing of the map starts a candidate, unless association left it undecided or it is
/// far. A candidate becomes a landmark, and the decision `kNew`, once it has been seen in several
/// frames and large enough in all of them together (plane_trial.h); while the map has no landmark,
/// large planes are landmarks at once. A map plane keeps the orientation of
/// its first observation. Memory is bounded per plane by the config. Cost: about 0.1 ms a plane
/// in view. Source: PAS-SLAM, Local Mapping (update of map planes).
void UpdatePlanes(Frame& frame, Map& map, const Camera& camera,
                  const AssociationConfig& association, const PlaneMapConfig& config);

}  // namespace slam
