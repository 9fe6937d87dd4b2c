#include "sim/sensor/calibration_error.h"

#include <Eigen/Geometry>
#include <cmath>

#include "sim/base/random.h"
#include "sim/sensor/noise.h"

namespace sim {
namespace {

constexpr double kFocal_px = 525;   // that registration_px is told for
constexpr double kCorner_px = 400;  // from the middle of 640 x 480 to its corner
/// Focal lengths of the two axes come from one calibration and err together but for this share.
/// Our choice: real ones agree to some hundredths of a per cent.
constexpr double kOwnShare = 0.2;

/// Keeps these draws apart from others of the device.
enum Stream : std::uint64_t { kRegistration = 0xCA11, kIntrinsics = 0xCA12 };

}  // namespace

Pose RegistrationError(const CalibrationError& error, std::uint64_t device) {
  Random random{device, kRegistration};
  // Two axes share the squared length of the shift.
  const double shift = error.registration_px / std::sqrt(2.0) / kFocal_px;
  const double roll = 0.5 * error.registration_px / kCorner_px;
  const double x = NormalDraw(random), y = NormalDraw(random), z = NormalDraw(random);
  const Eigen::Vector3d turn(shift * x, shift * y, roll * z);
  Pose pose;
  // Cayley's form of the turn: rational, so the same bits with every C library.
  const Eigen::Quaterniond q(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  pose.R = q.normalized().toRotationMatrix();
  return pose;
}

Camera ToldCamera(const Camera& camera, const CalibrationError& error, std::uint64_t device) {
  Random random{device, kIntrinsics};
  const double both = NormalDraw(random), own = NormalDraw(random);
  const double u = NormalDraw(random), v = NormalDraw(random);
  Camera told = camera;
  told.fx *= 1 + error.intrinsics * both;
  told.fy *= 1 + error.intrinsics * (both + kOwnShare * own);
  told.cx += error.intrinsics * u * camera.fx;
  told.cy += error.intrinsics * v * camera.fy;
  return told;
}

}  // namespace sim
