#pragma once

#include <string>

#include "slam/model/map_plane.h"

namespace slam {

/// Adds one observation of a plane's class and decides anew which class is believed in.
/// The class of a map plane is a belief over its observations, not the first label: a missed
/// detection weighs little against detections, a single false link little against many misses.
/// @param class_name  class of the frame plane; "" for none
/// @param score       of the detection, (0, 1]; 1 for none
void UpdateClassBelief(MapPlane& map_plane, const std::string& class_name, double score);

}  // namespace slam
