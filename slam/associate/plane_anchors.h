#pragma once

#include <utility>
#include <vector>

#include "slam/associate/plane_evidence.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Corrects the predicted pose by pairs (frame plane index, map plane id) that are beyond
/// doubt, with the prediction as prior and Huber weights; the covariance is that of the result.
UncertainPose CorrectByAnchors(const UncertainPose& predicted, const Frame& frame,
                               const Map& map, const std::vector<std::pair<int, int>>& anchors,
                               const AssociationConfig& config);

}  // namespace slam
