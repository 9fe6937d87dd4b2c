#pragma once

#include <Eigen/Geometry>

namespace sim {

struct SinCos {
  double sin = 0;
  double cos = 1;
};

/// Sine and cosine from exact reduction and a Taylor polynomial: no libm, whose last bit
/// depends on the processor. Error below 4e-16; exact at multiples of 90 degrees.
SinCos SinCosDeg(double angle_deg);

/// Angle of the vector (x, y), radians in [-pi, pi], and the arc sine of a value in [-1, 1]: no
/// libm either. Errors below 1e-14.
double Atan2Rad(double y, double x);
double AsinRad(double sine);

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kDegree_rad = kPi / 180;
inline double DegToRad(double angle_deg) { return angle_deg * kDegree_rad; }
inline double RadToDeg(double angle_rad) { return angle_rad * (180 / kPi); }

/// R = Rz(yaw) Ry(pitch) Rx(roll), all in degrees.
Eigen::Quaterniond QuaternionFromRpyDeg(const Eigen::Vector3d& rpy_deg);

/// The inverse up to rounding; pitch in [-90, 90].
Eigen::Vector3d RpyDegFromQuaternion(const Eigen::Quaterniond& q);

}  // namespace sim
