#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/camera/camera.h"
#include "sim/sensor/depth/depth_bend.h"
#include "sim/sensor/depth/return_loss.h"
#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// Time-of-flight depth as the Azure Kinect's in its narrow mode. Each effect can be switched
/// off alone: by 0, or by false.
/// Sources: [S] the maker's hardware specification (range, field, sd <= 17 mm, systematic error
/// < 11 mm + 0.1 % z); [T] Toelgyessy et al., Sensors 21(2):413, 2021, as fitted by
/// BlenderProc; [C] a choice of ours within [S].
struct AzureModel {
  double min_depth_m = 0.5, max_depth_m = 3.86;  ///< [S]
  double noise_scale = 1.0;                      ///< times AzureSigma; 0 = no axial noise
  double reflectivity = 0.9;                     ///< all surfaces' in the infrared, (0, 1] [C]
  double lateral_px = 0.25;                      ///< sd of edge jitter [T]
  bool flying_pixels = true;     ///< a pixel averages the light of its 3x3 footprint
  double max_mixed_m = 0.10;     ///< a mix whose ends are further apart is refused ... [C]
  double min_mixed_share = 0.2;  ///< ... when its own and all others give more light each [C]
  double multipath_m = 0.0075;   ///< added in the very corner of two surfaces at 90 deg [C]
  double multipath_reach_m = 0.05;  ///< falls to 0 this far from the corner [C]
  double multipath_loss = 0.2;      ///< share of pixels lost in the very corner [C]
  double wiggle_m = 0.002;          ///< amplitude of the cyclic error [C]
  double wiggle_period_m = 0.75;    ///< [C]
  double session_offset_m = 0.005;  ///< drawn once a recording: uniform in +- this [C]
  bool hexagon = true;              ///< the field is 75 x 65 deg; nothing outside [S]
  double rounding_m = 0.001;        ///< step of the sensor's output [S]
  /// Faces that give too little light or mirror too much have none; off unless asked for. [S] states
  /// the range, 3.86 m, for reflectivities from 15 % on: min_return_per_m2 = 0.15 / 3.86^2 = 0.01.
  ReturnLoss loss = {};
  DepthBend bend = {};  ///< none unless asked for: no published figure
};

/// sigma_z, metres: (0.5 mm + 1.0 mm/m max(z - 0.5 m, 0)) sqrt(0.9 / (reflectivity cosine)), at
/// most 17 mm. The curve is [T]; its growth as light fails is shot noise [C].
double AzureSigma(double z_m, double cosine, double reflectivity = 0.9);

/// Measured depth in metres, 0 = none. Order of effects: lateral jitter of edges, mixture of
/// the surfaces in the footprint, range and field, corners, cyclic error and offset, white
/// noise, rounding. The sd of a frontal plane, rounding included, is AzureSigma.
/// @param session  noise that is the same for all frames of a recording
cv::Mat1d MeasureDepth(const Rendering& rendering, const AzureModel& model,
                       const Camera& camera, const PixelNoise& noise,
                       const PixelNoise& session);

}  // namespace sim
