#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/camera/camera.h"
#include "sim/sensor/depth/depth_bend.h"
#include "sim/sensor/depth/match_window.h"
#include "sim/sensor/depth/return_loss.h"
#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

enum class SensorKind {
  kIdeal,         ///< exact depth, clean colour
  kKinect1,       ///< the first Kinect as its recordings are
  kKinect1Clean,  ///< its noise alone: nothing bends, all is in step and well calibrated
  kAzure,         ///< time of flight as the Azure Kinect's
  kD435,          ///< active stereo as the RealSense D435's
};

/// Structured-light depth, Kinect v1. Each step can be switched off alone.
///   sigma_z(z, theta) = 0.0012 + 0.0019 (z - 0.4)^2 [+ 0.0001/sqrt(z) theta^2/(pi/2 - theta)^2
///   above 60 deg], sigma_L(theta) = 0.8 + 0.035 theta/(pi/2 - theta) px
/// Source: Nguyen, Izadi, Lovell, 3DIMPVT 2012. Disparity is kept in steps of 1/8 px, z^2/351.3
/// m a step (f b = 585.5 px x 75 mm).
struct KinectModel {
  double disparity_m_steps = 351.3;   ///< 8 f b: disparity in steps is this / z
  double projector_offset_m = 0.075;  ///< along camera +x; shadows fall left of things; 0 = off
  double min_depth_m = 0.5, max_depth_m = 4.5;    ///< near mode: 0.4
  double max_incidence_rad = 1.3962634015954636;  ///< 80 deg; flatter surfaces give nothing
  double noise_scale = 1.0;                       ///< times sigma_z; 0 = no axial noise
  double lateral_scale = 1.0;                     ///< times sigma_L; 0 = sharp edges
  bool quantise = true;                           ///< to whole disparity steps
  DepthBend bend = {};                            ///< none unless asked for
  ReturnLoss loss = {};                           ///< none unless asked for
  MatchWindow window = {};                        ///< none unless asked for
};

/// As recordings of real ones are: bent, and with what they lack.
KinectModel RecordedKinect();

/// The numbers of sigma_z above, up to 60 degrees.
inline constexpr double kAxialFloor_m = 0.0012;
inline constexpr double kAxialGrowth_per_m = 0.0019;
inline constexpr double kAxialNearest_m = 0.4;

/// sigma_z of the model above, metres. `theta_rad` in [0, pi/2).
double AxialSigma(double z_m, double theta_rad);

/// Measured depth in metres, 0 = none, before rounding to file units. Order of effects: which
/// surface the pixel sees (lateral jitter moves edges, it does not tilt a plane), projector
/// shadow, lost light, mixed windows and limits there, disparity noise (white, averaged over 3x3 pixels and scaled back to
/// its sd), rounding to steps. `bend` comes before the limits. The sd of the result, quantisation included, is sigma_z. The
/// noise of a pixel depends on `noise` and the pixel alone; where depth_m is 0 so is the
/// result.
cv::Mat1d MeasureDepth(const Rendering& rendering, const KinectModel& model,
                       const PixelNoise& noise, const BendField* bend = nullptr);

/// 16-bit file units, rounded to nearest; 0 where there is no depth or it does not fit.
cv::Mat1w EncodeDepth(const cv::Mat1d& depth_m, double depth_factor);

}  // namespace sim
