#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "slam/base/field_visitor.h"
#include "slam/geometry/depth_noise.h"

namespace slam {

/// What measured the depth.
enum class DepthSensor { kKinect1, kAzure, kD435 };

/// Names as in files and on the command line, in the order of the enumeration.
const std::vector<std::string>& DepthSensorNames();

/// What a first Kinect bends flat things by, root mean square, as a share of the depth. Measured on
/// large flat surfaces of a real kitchen (docs/sensors.md).
inline constexpr double kKinectBend = 0.0033;
/// Angle of view over which it is alike: 25 of 640 columns, correlation exp(-1/2).
inline constexpr double kBendLength_rad = 0.048;

/// What is known of a depth sensor, whatever is done with its depth.
struct SensorModel {
  DepthSensor sensor = DepthSensor::kKinect1;
  DepthNoise noise;
  double bend_ratio = kKinectBend;  ///< as kKinectBend; 0: bends nothing that is known
  /// An error that goes with the distance alone, root mean square, as a share of it. It lifts a surface
  /// as a whole, and a plane that is seen frontally does not show it.
  double unseen_ratio = 0.0;
  /// How well the stamps of a colour and a depth image say how long after each other they were
  /// taken, seconds, standard deviation; 0: the device takes both at once.
  double stamp_sigma_s = 0.001;
  double max_depth_m = 10.0;
  /// How much wider depth makes near things, at most, on each side. Measured: -0.5 to 0.6 px of a first
  /// Kinect, real and simulated, and of a simulated Azure (docs/calibration.md).
  double edge_growth_px = 1.5;

  /// Standard deviation of a depth by noise and bend.
  double DepthSigma_m(double z_m) const {
    return std::hypot(noise.Sigma(z_m), bend_ratio * z_m);
  }
};

/// The model of a sensor:
///
/// - kKinect1: the defaults. Nguyen, Izadi, Lovell, "Modeling Kinect sensor noise", 3DIMPVT
///   2012.
/// - kAzure: time of flight. Noise of 0.5 mm + 1 mm/m (z - 0.5 m) on light surfaces, more on
///   others, as fitted by Toelgyessy et al., "Evaluation of the Azure Kinect", Sensors 21(2),
///   2021, and a systematic error, within the data sheet's 11 mm + 0.1 % of distance, taken as
///   a wave of 2 mm over fractions of a metre. It does not average out over a surface.
/// - kD435: active stereo. The error is one of disparity: sigma(z) = z^2 0.08 px / (430 px x
///   50.15 mm), subpixel error and formula of Intel's "Tuning D435 and D415 cameras for best
///   performance". Matching windows of 7 x 7 pixels share most of it.
SensorModel ModelOf(DepthSensor sensor);

/// A named sensor brings its whole model with it; the keys beside it go over that.
inline void VisitFields(SensorModel& c, FieldVisitor& v) {
  const DepthSensor before = c.sensor;
  v.Named("model", c.sensor, DepthSensorNames(),
          "what measured the depth; the defaults of noise and plane_extraction follow from it");
  if (c.sensor != before) c = ModelOf(c.sensor);
  v.Section("noise", "standard deviation of a depth as a function of depth and incidence",
            c.noise);
  v.Number(
      "unseen_ratio", c.unseen_ratio, "[0, 0.1]",
      "error that goes with the distance alone, root mean square, as a part of it: planes do "
      "not show it");
  v.Number("stamp_sigma_s", c.stamp_sigma_s, "[0, 1]",
           "standard deviation of the time between a colour and a depth image, as stamped");
  v.Number("max_depth_m", c.max_depth_m, "(0, inf)",
           "depth from which on no plane is looked for");
}

}  // namespace slam
