#pragma once

#include <cstdint>

#include "sim/base/pose.h"
#include "sim/camera/camera.h"

namespace sim {

/// What the calibration of a sensor leaves wrong, the same in all recordings of one device;
/// nothing by default.
struct CalibrationError {
  /// Depth lies this far beside the colour it belongs to, rms over devices, pixels of a camera
  /// of 525 px.
  double registration_px = 0;
  /// Sd of the focal length and the principal point that camera.yaml tells, as shares of the
  /// focal length.
  double intrinsics = 0;
};

/// From the camera that depth is taken with to the camera that it is said to be taken with: a
/// turn, about an axis across the sight for the shift, and along it for half as much at the
/// image's corners.
Pose RegistrationError(const CalibrationError& error, std::uint64_t device);

/// The camera as its calibration tells it. Size, lens, rate and unit are those of `camera`.
Camera ToldCamera(const Camera& camera, const CalibrationError& error, std::uint64_t device);

}  // namespace sim
