#pragma once

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// Tells the features of a frame, and their depths, for another speed than `frame.speed`, which
/// they were told for: rows were read, and depth was measured, from elsewhere (Frame::readout,
/// Frame::T_dc). Once a pose is found the speed is known twice as well as it was predicted.
///
/// Speed and readout become the new ones; the speed's covariance and planes stay. Each depth stays
/// what its pixel of the depth image said. A frame whose colour and depth are of one moment stays
/// as it is.
/// @returns whether anything was told anew
bool TellAtSpeed(const Camera& camera, const Vector6d& speed, Frame& frame);

}  // namespace slam
