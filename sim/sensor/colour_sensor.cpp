#include "sim/sensor/colour_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "sim/sensor/recycled.h"

namespace sim {
namespace {

constexpr int kCodes = 8192;
constexpr std::uint32_t kFirstDraw = 8;  ///< after the depth sensor's; three of one set of bits

using GammaCodes = std::array<uchar, kCodes + 1>;

/// 8-bit code of linear light in [0, 1], tabulated.
GammaCodes MakeGammaCodes(double gamma) {
  GammaCodes table{};
  for (std::size_t i = 0; i <= kCodes; ++i) {
    const double light = static_cast<double>(i) / kCodes;
    table[i] = static_cast<uchar>(255.0 * std::pow(light, 1.0 / gamma) + 0.5);
  }
  return table;
}

/// The last table of this thread; frames share one.
const GammaCodes& GammaTable(double gamma) {
  thread_local double made_for = 0;
  thread_local GammaCodes table;
  if (made_for != gamma) {
    table = MakeGammaCodes(gamma);
    made_for = gamma;
  }
  return table;
}

}  // namespace

ColourModel CleanColour() {
  return {.shot_variance = 0, .read_sigma = 0, .corner_loss = 0, .gamma = 2.2};
}

cv::Mat3b MeasureColour(const cv::Mat3f& radiance, const ColourModel& model,
                        const PixelNoise& noise) {
  const GammaCodes& table = GammaTable(model.gamma);
  const bool noisy = model.shot_variance > 0 || model.read_sigma > 0;
  const auto shot_variance = static_cast<float>(model.shot_variance);
  const auto read_variance = static_cast<float>(model.read_sigma * model.read_sigma);
  const double mid_u = 0.5 * (radiance.cols - 1), mid_v = 0.5 * (radiance.rows - 1);
  const double loss = model.corner_loss / std::max(1e-9, mid_u * mid_u + mid_v * mid_v);
  thread_local cv::Mat3b kept;
  cv::Mat3b image = Recycled(kept, radiance.size());
  for (int v = 0; v < radiance.rows; ++v) {
    const cv::Vec3f* in = radiance[v];
    cv::Vec3b* out = image[v];
    for (int u = 0; u < radiance.cols; ++u) {
      const double r2 = (u - mid_u) * (u - mid_u) + (v - mid_v) * (v - mid_v);
      const auto kept_light = static_cast<float>(1.0 - loss * r2);
      const std::uint64_t bits = noisy ? noise.NormalBits(u, v, kFirstDraw) : 0;
      for (std::uint32_t channel = 0; channel < 3; ++channel) {
        float light = kept_light * in[u][static_cast<int>(channel)];
        if (noisy) {
          const float sigma = std::sqrt(shot_variance * std::max(light, 0.0F) + read_variance);
          light += sigma * PixelNoise::NormalOf(bits, kFirstDraw + channel);
        }
        const float code = std::clamp(light, 0.0F, 1.0F) * kCodes + 0.5F;
        out[u][2 - static_cast<int>(channel)] = table[static_cast<std::size_t>(code)];
      }
    }
  }
  return image;
}

}  // namespace sim
