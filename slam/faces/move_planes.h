#pragma once

#include <vector>

#include "slam/geometry/pose.h"
#include "slam/model/frame_plane.h"

namespace slam {

/// Tells planes as another camera nearby would have measured them: everything in metres moves,
/// everything in pixels stays. A plane that the other camera would see from behind stays as it is. A small motion, T_to_from.
void MovePlanes(const Pose& T_to_from, std::vector<FramePlane>& planes);

}  // namespace slam
