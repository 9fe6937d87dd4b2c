#pragma once

#include <vector>

#include "slam/model/map.h"

namespace slam {

/// Poses of all keyframes, culled ones too, by id.
std::vector<Pose> KeyframePoses(const Map& map);

/// Moves the plane as a rigid whole: parameters, estimate, cloud, corners, outline.
/// @param T_new_old  from where it was to where it is, both in the world
void MovePlane(MapPlane& plane, const Pose& T_new_old);

/// Carries points along with the keyframe that made them.
/// @param before  poses of the keyframes by id when the points were placed; the map holds the
///   present ones
void CarryPoints(Map& map, const std::vector<Pose>& before);

/// Carries landmarks along with the keyframe nearest in time to their first sighting, and
/// candidates with the newest one.
void CarryPlanes(Map& map, const std::vector<Pose>& before);

}  // namespace slam
