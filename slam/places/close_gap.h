#pragma once

#include <Eigen/Core>

#include "slam/model/map.h"

namespace slam {

/// What a frame tells of the one before that was found `off_w` from where motion led: it may have moved
/// otherwise, or have been elsewhere before.
/// @param now_w, before_w  covariances of the two frames' places in the world
/// @param motion_w         of what the camera may have moved otherwise in between
FoundPlace FoundOff(const Eigen::Vector3d& off_w, const Eigen::Matrix3d& now_w,
                    const Eigen::Matrix3d& before_w, const Eigen::Matrix3d& motion_w);

/// Whether that is a clear way, along a direction that is known much better since.
bool ClosesGap(const FoundPlace& found);

/// Draws the map together where a keyframe closes gaps: what came before it was off in the world as
/// far as it is found off, each keyframe by the share of that uncertainty that it had itself, back to
/// where the camera knew its place. Points and planes are carried along; the first keyframe, the
/// world, and the new one stay. So a Kalman smoother corrects the past of a random walk (Rauch, Tung
/// and Striebel 1965).
/// @returns whether anything moved
bool CloseGaps(Map& map, int keyframe);

}  // namespace slam
