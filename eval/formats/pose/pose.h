#pragma once

#include <Eigen/Core>
#include <vector>

namespace eval {

/// Coordinates in files are nearer than this. Map projections (UTM) and earth-centred coordinates
/// are below 1e7 m, where a double still resolves 2e-9 m; 1e200 overflows when it is squared.
inline constexpr double kMaxCoordinate_m = 1e7;

/// Rigid motion T_ab: takes coordinates in b to coordinates in a, x_a = R x_b + t.
///
/// Frames of the evaluation: g world of the truth, w world of the run, c camera.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();  ///< metres

  Eigen::Vector3d operator*(const Eigen::Vector3d& x_b) const { return R * x_b + t; }
  Pose operator*(const Pose& T_bc) const { return {R * T_bc.R, R * T_bc.t + t}; }
};

/// T_ba of T_ab.
Pose Inverse(const Pose& T_ab);

/// Rotation of the quaternion (x, y, z, w), normalised first.
/// @throws std::invalid_argument if its length is below 1e-9 or not finite.
Eigen::Matrix3d RotationOf(double x, double y, double z, double w);

/// Angle of a rotation, radians in [0, pi]:
///   atan2(|vee(R - R^T)|, tr R - 1), which keeps its digits near 0 and pi where acos does not.
double AngleOf(const Eigen::Matrix3d& R);

/// A pose with the time it belongs to.
struct StampedPose {
  double stamp_s = 0.0;
  Pose T_wc;     ///< camera to world
  int line = 0;  ///< in its file; 0 when it comes from none
};

/// Poses in the order of their file.
using Trajectory = std::vector<StampedPose>;

}  // namespace eval
