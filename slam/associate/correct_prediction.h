#pragma once

#include <utility>
#include <vector>

#include "slam/associate/plane_comparison.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// The frame's pose with what association may assume of its error: its covariance, what its
/// points share, and what the sensor bends.
UncertainPose PredictedPose(const Frame& frame);

/// Keyframes since a landmark was last seen: so many links lie between it and the map around the
/// camera, which is what the pose is known against.
int LinksTo(const MapPlane& landmark, const Map& map);

/// The pose as against a landmark so many links away. From keyframe to keyframe the camera's place
/// is handed on by points that are seen from elsewhere and through other bends; so every link adds
/// what one frame's pose is uncertain by, which is `predicted`, and drift grows as in a random walk.
UncertainPose WithDrift(const UncertainPose& pose, const UncertainPose& predicted, int links);

/// Corrects the predicted pose by pairs (frame plane index, id of a landmark) that are beyond
/// doubt, with the prediction as prior and Huber weights; the covariance is that of the result.
UncertainPose CorrectPrediction(const UncertainPose& predicted, const Frame& frame,
                                const Map& map, const std::vector<std::pair<int, int>>& certain,
                                const AssociationConfig& config);

}  // namespace slam
