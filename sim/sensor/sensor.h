#pragma once

#include <map>
#include <string>
#include <variant>

#include "sim/sensor/calibration_error.h"
#include "sim/sensor/colour_sensor.h"
#include "sim/sensor/depth/azure_sensor.h"
#include "sim/sensor/depth/d435_sensor.h"
#include "sim/sensor/depth/depth_sensor.h"
#include "sim/sensor/exposure.h"
#include "sim/sensor/timing_defects.h"

namespace sim {

/// Exact depth.
struct IdealModel {};
using DepthModel = std::variant<IdealModel, KinectModel, AzureModel, D435Model>;

/// A depth sensor with its colour camera, and how a recording of it goes: one of ours, or one of
/// a user's file.
struct Sensor {
  Sensor(SensorKind kind = SensorKind::kKinect1);  // NOLINT: a kind is a sensor
  std::string base;                                ///< as in kSensorNames
  std::string name;                                ///< the same, or a name of the user's
  DepthModel depth;
  ColourModel colour;
  Exposure exposure;  ///< the colour camera's
  TimingDefects timing;
  CalibrationError calibration;
  Lens lens;  ///< what its calibration found; cameras that name a lens of their own keep it
  /// Parameters that a file has set, by their keys in it; they go into the manifest.
  std::map<std::string, double> changed;
};

/// Where the sensor's second eye (projector or right imager) is, metres along camera +x; what
/// it cannot reach has no depth. 0 = there is none. RenderOptions wants to know.
double SecondEyeOffset(const DepthModel& model);

/// Published or defined sd of depth of a surface seen at an angle, metres; 0 for ideal.
double DepthSigma(const DepthModel& model, double z_m, double theta_rad);

/// Step between neighbouring depths that the sensor can report, at z, metres; 0 for ideal.
double DepthStep(const DepthModel& model, double z_m);

/// Error that the model's systematic effects give to a wall far from anything, metres, without
/// the offset of the session.
double DepthBias(const DepthModel& model, double z_m);

/// What names the device that `seed` records with: the model's, else the seed.
std::uint64_t DeviceOf(const DepthModel& model, std::uint64_t seed);

/// What the device adds to depth, as a share of it, height x width; empty when nothing bends.
cv::Mat1f DevicePattern(const DepthModel& model, const Camera& camera, std::uint64_t seed);

/// Measured depth in metres, 0 = none. Depends on the rendering, the model, the seed and the
/// frame alone.
cv::Mat1d MeasureDepth(const Rendering& rendering, const DepthModel& model,
                       const Camera& camera, std::uint64_t seed, std::uint64_t frame);

}  // namespace sim
