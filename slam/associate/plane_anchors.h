#pragma once

#include <utility>
#include <vector>

#include "slam/associate/plane_evidence.h"
#include "slam/model/frame.h"
#include "slam/model/map_plane.h"

namespace slam {

/// Corrects the predicted pose by pairs (frame plane index, index into `planes`) that are
/// beyond doubt, with the prediction as prior and Huber weights; the covariance is that of the
/// result.
UncertainPose CorrectByAnchors(const UncertainPose& predicted, const Frame& frame,
                               const std::vector<MapPlane>& planes,
                               const std::vector<std::pair<int, int>>& anchors,
                               const AssociationConfig& config);

}  // namespace slam
