#pragma once

#include "slam/geometry/camera.h"
#include "slam/model/frame.h"

namespace slam {

/// Compensates the camera's motion in the features of a frame, and in their depths, for another speed
/// than `frame.speed`, for which that was done before (ReadDepths): rows were read, and depth was
/// measured, from elsewhere (Frame::readout, Frame::T_dc). Once a pose is found the speed is known
/// twice as well as it was predicted.
///
/// Speed and readout become the new ones; the speed's covariance and planes stay. Each depth stays
/// what its pixel of the depth image said. A frame whose colour and depth are of one moment stays
/// as it is.
/// @returns whether anything was moved
bool CompensateMotion(const Camera& camera, const Vector6d& speed, Frame& frame);

}  // namespace slam
