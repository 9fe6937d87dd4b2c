#pragma once

#include "slam/model/frame.h"

namespace slam {

/// What the depth camera bends (Frame::bend_ratio) lifts and tilts all that a pose is found by, map
/// and frame, whatever their number: a covariance of xi in T_cw <- Exp(xi) T_cw, to be added to
/// what independent errors come to. Where the planes of the frame lie, on the mean, or its points
/// if it has no planes.
Matrix6d BendCovariance(const Frame& frame);

/// The same of a shutter of which is not known how long it takes to read an image: the rows of a
/// camera that moves do not agree on one pose, and the map's are read like the frame's.
Matrix6d ShutterCovariance(const Frame& frame);

/// What is known of the error of a tracked frame's pose towards the map, all in all: zero for the
/// frame that starts the map, which is the world.
Matrix6d PoseErrorCovariance(const Frame& frame);

/// Covariance of the frame's pose in the world by what it was found by, without what the sensor does. The
/// pose is found towards the map, but is no better known than the map is there: after a way along a
/// blank wall all that is mapped next lies as far off as the camera may have gone.
Matrix6d CovarianceInWorld(const Frame& frame);

/// Likewise, all in all.
Matrix6d WorldErrorCovariance(const Frame& frame);

/// What that says of the camera's place, in the world's axes.
Eigen::Matrix3d PlaceCovariance(const Pose& T_cw, const Matrix6d& covariance);

/// Variance of how far a surface with this normal at x_c, as a camera sees it, lies off the map.
/// @param covariance  of the camera's pose
double VarianceAlong(const Matrix6d& covariance, const Eigen::Vector3d& n_c,
                     const Eigen::Vector3d& x_c);

/// A covariance that is nowhere smaller than either: where `bound` is larger, along the axes that both
/// have in common, it is that. Their sum where the first is singular, and so has no such axes.
Matrix6d AtLeast(const Matrix6d& covariance, const Matrix6d& bound);

}  // namespace slam
