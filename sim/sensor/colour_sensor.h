#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/sensor/noise.h"

namespace sim {

/// The colour camera: vignetting, shot and read noise, gamma, 8 bits.
struct ColourModel {
  double shot_variance = 1.4e-4;  ///< variance of linear light where that is 1; in proportion
  double read_sigma = 1.0e-3;     ///< standard deviation of linear light
  double corner_loss = 0.12;      ///< share of light lost in the image's corners
  double gamma = 2.2;
  double reflections = 0;  ///< as FrameRenderer's; 1 = in full
};

/// A camera without noise or vignetting; gamma only.
ColourModel CleanColour();

/// 8-bit image, channels in OpenCV's order (blue first), of linear RGB radiance.
cv::Mat3b MeasureColour(const cv::Mat3f& radiance, const ColourModel& model,
                        const PixelNoise& noise);

}  // namespace sim
