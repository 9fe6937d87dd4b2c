#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/sensor/noise.h"
#include "sim/trace/frame_renderer.h"

namespace sim {

/// What the depth sensors' models share. Draws 0 to 7 of a pixel belong to depth.
enum DepthDraw : std::uint32_t {
  kAxialDraw = 0,
  kJitterUDraw = 1,
  kJitterVDraw = 2,
  kLossDraw = 3,
  kWhiteDraw = 4,
  kSessionDraw = 5,
  kReturnDraw = 6,
  kMirrorDraw = 7,
  kWindowDraw = 4  ///< of a sensor that has no kWhiteDraw
};

/// White noise averaged over (2 radius + 1)^2 pixels, sd restored to 1. Defined beyond the
/// border too: no pixel has less of it.
cv::Mat1f SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise,
                      std::uint32_t draw);

/// The same row by row, so that no whole image of it is needed.
class SmoothNoiseRows {
 public:
  /// Before row 0. Memory of the last time is used again.
  void Start(int width, int radius, const PixelNoise& noise, std::uint32_t first_draw,
             std::size_t draws);
  void Next();
  /// Draw first_draw + k of the row that Next came to.
  const float* Row(std::size_t k) const { return smooth_.data() + k * width_; }

 private:
  void AddRow(int v);
  float* Across(int v, std::size_t k);

  PixelNoise noise_{0, 0};
  int radius_ = 0, row_ = -1;
  std::uint32_t first_draw_ = 0;
  std::size_t draws_ = 0, width_ = 0, side_ = 1;
  std::vector<std::uint64_t> bits_;
  std::vector<float> white_, smooth_;
  std::vector<float> across_;  ///< sums along the rows that this one needs, in a ring
};

/// Angle between ray and normal, radians, from its cosine, to 3e-8 (Abramowitz and Stegun
/// 4.4.46; no libm, so the same bits with every C library).
inline double Incidence(float cosine) {
  const double c = std::clamp(static_cast<double>(cosine), 0.0, 1.0);
  const double series =
      1.5707963050 +
      c * (-0.2145988016 +
           c * (0.0889789874 +
                c * (-0.0501743046 +
                     c * (0.0308918810 +
                          c * (-0.0170881256 + c * (0.0066700901 - c * 0.0012624911))))));
  return std::sqrt(1.0 - c) * series;
}

/// Both pixels show the same plane of the same object.
inline bool SameSurface(const Rendering& rendering, cv::Point a, cv::Point b) {
  return rendering.plane_id(a) == rendering.plane_id(b) &&
         rendering.object_id(a) == rendering.object_id(b);
}

/// An image of what the sensor measures at each pixel.
template <typename Sensor>
cv::Mat1d MeasureEach(const Sensor& sensor, cv::Size size) {
  cv::Mat1d measured(size);
  for (int v = 0; v < measured.rows; ++v) {
    for (int u = 0; u < measured.cols; ++u) measured(v, u) = sensor.At(u, v);
  }
  return measured;
}

/// z rounded to whole multiples of step_m; unchanged when step_m is 0.
double RoundDepth(double z_m, double step_m);

/// Gaussian sd that, with roundings to steps a and b (variance step^2/12 each), gives `sigma`
/// in all; never below a sixth of the larger step, where the sum of variances would not hold.
double SigmaBeforeRounding(double sigma, double step_a, double step_b);

}  // namespace sim
