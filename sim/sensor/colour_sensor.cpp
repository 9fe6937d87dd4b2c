#include "sim/sensor/colour_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sim {
namespace {

constexpr int kCodes = 8192;
constexpr std::uint32_t kFirstDraw = 8;  ///< after those of the depth sensor

/// 8-bit code of linear light in [0, 1], tabulated.
std::array<uchar, kCodes + 1> GammaTable(double gamma) {
  std::array<uchar, kCodes + 1> table{};
  for (std::size_t i = 0; i <= kCodes; ++i) {
    const double light = static_cast<double>(i) / kCodes;
    table[i] = static_cast<uchar>(255.0 * std::pow(light, 1.0 / gamma) + 0.5);
  }
  return table;
}

}  // namespace

ColourModel CleanColour() {
  return {.shot_variance = 0, .read_sigma = 0, .corner_loss = 0, .gamma = 2.2};
}

cv::Mat3b MeasureColour(const cv::Mat3f& radiance, const ColourModel& model,
                        const PixelNoise& noise) {
  const auto table = GammaTable(model.gamma);
  const bool noisy = model.shot_variance > 0 || model.read_sigma > 0;
  const double read_variance = model.read_sigma * model.read_sigma;
  const double mid_u = 0.5 * (radiance.cols - 1), mid_v = 0.5 * (radiance.rows - 1);
  const double corner2 = std::max(1e-9, mid_u * mid_u + mid_v * mid_v);
  cv::Mat3b image(radiance.size());
  for (int v = 0; v < radiance.rows; ++v) {
    for (int u = 0; u < radiance.cols; ++u) {
      const double r2 = ((u - mid_u) * (u - mid_u) + (v - mid_v) * (v - mid_v)) / corner2;
      const double kept = 1.0 - model.corner_loss * r2;
      for (int channel = 0; channel < 3; ++channel) {
        double light = kept * static_cast<double>(radiance(v, u)[channel]);
        if (noisy) {
          const double sigma =
              std::sqrt(model.shot_variance * std::max(light, 0.0) + read_variance);
          light += sigma * noise.Normal(u, v, kFirstDraw + static_cast<std::uint32_t>(channel));
        }
        const double code = std::clamp(light, 0.0, 1.0) * kCodes + 0.5;
        image(v, u)[2 - channel] = table[static_cast<std::size_t>(code)];
      }
    }
  }
  return image;
}

}  // namespace sim
