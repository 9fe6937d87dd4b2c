#pragma once

#include <map>
#include <set>

#include "slam/mapping/bundle/bundle_window.h"

namespace slam {

/// Adds the landmarks that a free keyframe of the window and some other keyframe have seen, with
/// their observations, and, if asked for, the window's points that lie on them.
///
/// What keyframes outside of the window have seen of a landmark becomes one prior, at their poses
/// of now: their observations and those inside make up all that keyframes know, each counted
/// once. Frames between keyframes do not count: the map gave them their poses.
/// @param pose_at  place of each keyframe of the window among its poses, by id
void AddPlanes(const Map& map, const std::map<int, std::size_t>& pose_at,
               const LocalBundleConfig& config, BundleWindow& window);

/// Takes the planes of a solved window over into the map, which has its old poses still. A
/// landmark moves, with all that it has, as what keyframes have seen of it has moved with them,
/// so its plane goes on being what the latest frames measure best.
/// @returns ids of the landmarks that were placed; of others no keyframe counts any more
std::set<int> MergePlanes(const BundleWindow& window, Map& map);

}  // namespace slam
