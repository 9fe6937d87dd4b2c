#pragma once

#include "slam/geometry/uncertain_pose.h"
#include "slam/pose/solve.h"

namespace slam {

/// Planes that were measured at another time than that of the pose: they tell the pose of that time,
/// and how the camera moved in between is unknown, too. It goes with the pose (SpeedByPose) and with
/// what the planes say. Were they taken as if the speed were known, its error would move the pose,
/// that the next frame's speed, and that its planes: an error that grows where depth is earlier.
struct LatePlanes {
  double late_s = 0.0;  ///< Frame::depth_late_s; negative: earlier
  /// The speed for which the motion between the two times was compensated in the planes.
  Vector6d compensated_speed = Vector6d::Zero();
  SpeedByPose speed;  ///< of the camera

  /// From where planes are seen as they are compensated, when the camera is at T_cw and as fast as
  /// that says.
  Pose SeenFrom(const Pose& T_cw) const;
  /// What equations of that pose say of T_cw, whatever the speed is.
  NormalEquations OfPose(const NormalEquations& seen) const;
  /// The speed when the camera is at T_cw, by the equations at SeenFrom(T_cw), too.
  Vector6d SpeedAt(const Pose& T_cw, const NormalEquations& seen) const;
};

}  // namespace slam
