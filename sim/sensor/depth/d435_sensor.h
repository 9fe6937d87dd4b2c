#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/camera/camera.h"
#include "sim/sensor/depth/depth_bend.h"
#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// Active-stereo depth as the RealSense D435's. Each effect can be switched off alone: by 0.
/// Sources: [I] the maker's white papers "Tuning depth cameras for best performance" (RMS law,
/// sub-pixel error of a textured wall 0.05 to 0.1 px) and "Subpixel linearity"; [P] the
/// calibrated unit in SAPIEN (f = 430.14 px at 848 px, baseline 50.15 mm); [D] the data sheet;
/// [C] a choice of ours.
struct D435Model {
  double focal_baseline_px_m = 21.57;  ///< f B [P]
  /// Right imager along camera +x; 0 = no shadow, no blind band [P].
  double baseline_m = 0.05015;
  double subpixel_px = 0.08;      ///< sd of disparity; 0 = no noise [I]
  double correlated_share = 0.7;  ///< part of the variance, smooth over the window [C]
  int window_px = 7;              ///< side of the matching window, odd [P]
  double grid_px = 1.0 / 32.0;    ///< disparity is kept in steps of this [I]
  double ripple_px = 0.03;        ///< sub-pixel error ripple_px sin(2 pi d) [I]
  int fattening_px = 3;           ///< near things grow by this at borders [C]
  double max_mixed_px = 1.0;  ///< window that sees disparities further apart is refused ... [C]
  double min_share = 0.6;  ///< ... unless its own surface, or all else, has more; 0 = never [C]
  double min_depth_m = 0.28, max_depth_m = 10.0;  ///< [D]
  double rounding_m = 0.001;                      ///< step of the sensor's output [D]
  DepthBend bend = {};  ///< none unless asked for: no published figure
};

/// sigma_z = z^2 s / (f B), metres. Source: [I].
double D435Sigma(double z_m, const D435Model& model = {});

/// Measured depth in metres, 0 = none. Order of effects: fattening of near things, range, blind
/// band and shadow of the right imager, windows that see two surfaces, sub-pixel ripple and
/// noise, rounding of disparity and of depth. The sd of a plane, roundings included, is
/// D435Sigma. Windows are counted in pixels of the image.
cv::Mat1d MeasureDepth(const Rendering& rendering, const D435Model& model, const Camera& camera,
                       const PixelNoise& noise);

}  // namespace sim
