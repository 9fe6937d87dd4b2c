#pragma once

#include "slam/associate/association_config.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// Tests the frame's matches with landmarks again at its optimised pose, by the bounds of
/// association on parameters and on footprints, and takes back those that it contradicts: the pose
/// is known better by now than when it was predicted, with what the sensor bends
/// (PoseErrorCovariance). Which surface they show is in doubt then (kAmbiguous), so they start no
/// candidate either.
/// @returns how many
int TakeBackContradicted(Frame& frame, const Map& map, const Camera& camera,
                         const AssociationConfig& config);

}  // namespace slam
