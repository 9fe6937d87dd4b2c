#pragma once

#include <optional>

#include "slam/places/keyframe_index.h"
#include "slam/places/place_search.h"

namespace slam {

/// Asks the index which keyframes look like the frame, and the newest one besides; matches the
/// frame's descriptors with theirs, and asks RANSAC over P3P and the pose optimisation for a
/// pose; the keyframe with the most inliers wins. Nothing is found rather than a pose with
/// fewer than `place.min_ransac_inliers`, or one of two that are nearly as good; the caller
/// confirms it with the local map. Deterministic: samples are keyed by frame and keyframe.
/// @param index  up to date with the map
std::optional<PlacePose> Relocalise(const Frame& frame, const Map& map,
                                    const KeyframeIndex& index, const Camera& camera,
                                    const FeatureScale& scale, const PointSearchConfig& search);

}  // namespace slam
