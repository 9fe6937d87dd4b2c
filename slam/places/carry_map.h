#pragma once

#include <set>
#include <vector>

#include "slam/model/map.h"

namespace slam {

/// Poses of all keyframes, culled ones too, by id.
std::vector<Pose> KeyframePoses(const Map& map);

/// Carries points along with the keyframe that made them.
/// @param before  poses of the keyframes by id when the points were placed; the map holds the
///   present ones
void CarryPoints(Map& map, const std::vector<Pose>& before);

/// T_new_old of what a frame was the first to see: it moved with the keyframe nearest to it in time.
Pose CarriageSince(const Map& map, const std::vector<Pose>& before, int first_frame);

/// Carries landmarks along with the keyframe nearest in time to their first sighting, the planes supposed
/// at their edges with that of the edge's, and candidates with the newest one.
/// @param placed  ids of planes that stay: the adjustment that moved the keyframes has placed them
void CarryPlanes(Map& map, const std::vector<Pose>& before, const std::set<int>& placed = {});

}  // namespace slam
