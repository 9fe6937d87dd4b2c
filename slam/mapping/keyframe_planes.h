#pragma once

#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/structure/supposed_planes.h"

namespace slam {

/// Keeps in a keyframe what a frame has seen of map planes: its own frame, or one that is tied to
/// it, at the frame's pose relative to it. So each frame counts once, with one keyframe, and an
/// adjustment that moves the keyframe moves what the frame has seen. Kept are trusted planes that
/// show a landmark; of the keyframe's own frame also those of candidates, which may become one.
/// A culled keyframe keeps nothing. Edges and corners are kept of its own frame alone.
void KeepPlanes(const Frame& frame, const PlaneMapConfig& config,
                const SupposedConfig& supposed, Keyframe& keyframe);

/// The landmark that the keyframe's plane shows by now, after fusions. Null: it was taken back,
/// or the map plane is a candidate still or has failed its trial.
const MapPlane* LandmarkOf(const Map& map, const KeyframePlane& plane);

}  // namespace slam
