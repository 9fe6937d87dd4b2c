#pragma once

#include <Eigen/Core>

#include "slam/model/map.h"

namespace slam {

/// What a frame tells of the one before: that it was so far off, which is known so well.
struct FoundPlace {
  Eigen::Vector3d off_w = Eigen::Vector3d::Zero();  ///< world axes
  Eigen::Matrix3d covariance_w =
      Eigen::Matrix3d::Zero();  ///< of the camera's place in the world
};

/// Of a frame that was found `off_w` from where motion led.
/// @param covariance_w  of its place in the world
/// @param before_w      the same of the frame before
/// @param motion_w      of what the camera may have moved otherwise than it was led since
FoundPlace FoundOff(const Eigen::Vector3d& off_w, const Eigen::Matrix3d& covariance_w,
                    const Eigen::Matrix3d& before_w, const Eigen::Matrix3d& motion_w);

/// Whether that is a clear way, along a direction that is known much better now than at the newest
/// keyframe.
bool ClosesGap(const Map& map, const FoundPlace& found);

/// Draws the map together where a keyframe closes gaps: what came before it was off in the world as
/// far as it is found off, each keyframe by the share of that uncertainty that it had itself, back to
/// where the camera knew its place. Points and planes are carried along; the first keyframe, the
/// world, and the new one stay. So a Kalman smoother corrects the past of a random walk (Rauch, Tung
/// and Striebel 1965).
/// @returns whether anything moved
bool CloseGaps(Map& map, int keyframe);

}  // namespace slam
