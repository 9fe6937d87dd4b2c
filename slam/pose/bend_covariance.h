#pragma once

#include "slam/model/frame.h"

namespace slam {

/// What the depth camera bends (Frame::bend_ratio) lifts and tilts all that a pose is found by, map
/// and frame, whatever their number: a covariance of xi in T_cw <- Exp(xi) T_cw, to be added to
/// what independent errors come to. Where the planes of the frame lie, on the mean; no planes, no
/// lift.
Matrix6d BendCovariance(const Frame& frame);

/// What is known of the error of a tracked frame's pose towards the map, all in all: zero for the
/// frame that starts the map, which is the world.
Matrix6d PoseErrorCovariance(const Frame& frame);

}  // namespace slam
