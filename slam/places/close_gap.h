#pragma once

#include <Eigen/Core>

#include "slam/model/map.h"

namespace slam {

/// Where a camera was found that had come some way without anything telling how far.
struct FoundPlace {
  Eigen::Vector3d off_w = Eigen::Vector3d::Zero();  ///< from where motion led, world axes
  Eigen::Matrix3d covariance_w = Eigen::Matrix3d::Zero();  ///< of its place in the world
};

/// Whether the camera is found a clear way off, along a direction that it knows much better than at the
/// newest keyframe.
bool ClosesGap(const Map& map, const FoundPlace& found);

/// Draws the map together where a keyframe closes gaps: what came before it was off in the world as
/// far as it is found off, each keyframe by the share of that uncertainty that it had itself, back to
/// where the camera knew its place. Points and planes are carried along; the first keyframe, the
/// world, and the new one stay. So a Kalman smoother corrects the past of a random walk (Rauch, Tung
/// and Striebel 1965).
/// @returns whether anything moved
bool CloseGaps(Map& map, int keyframe);

}  // namespace slam
