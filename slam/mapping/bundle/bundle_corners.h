#pragma once

#include "slam/mapping/bundle/bundle_window.h"

namespace slam {

/// Adds the corners of the window's newest plane that a free keyframe of the window and some
/// other of it have seen, each a point of the plane, with their observations: f_v, as in the pose.
/// A corner that was seen is the landmark's nearest within kMaxVertexJump_m.
void AddCorners(const Map& map, const MapPlane& landmark,
                const std::map<int, std::size_t>& pose_at, BundleWindow& window);

}  // namespace slam
