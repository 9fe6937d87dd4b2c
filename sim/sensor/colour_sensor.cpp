#include "sim/sensor/colour_sensor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/sensor/colour_rows.h"
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
  return {
      .shot_variance = 0, .read_sigma = 0, .corner_loss = 0, .gamma = 2.2, .reflections = 0};
}

namespace {

/// One row of samples: three a pixel, in radiance's order.
struct Samples {
  std::vector<std::uint64_t> bits;
  std::vector<float> kept, normal;
  std::vector<std::int32_t> codes;
  void Start(int width) {
    const auto count = static_cast<std::size_t>(3 * width);
    bits.resize(static_cast<std::size_t>(width));
    kept.resize(count);
    normal.assign(count, 0.0F);
    codes.resize(count);
  }
  void Draw(const PixelNoise& noise, int v) {
    noise.NormalBitsOfRow(0, v, kFirstDraw, bits);
    for (std::uint32_t k = 0; k < 3; ++k) {
      PixelNoise::NormalsOf(bits, kFirstDraw + k, 3, normal.data() + k);
    }
  }
};

}  // namespace

cv::Mat3b MeasureColour(const cv::Mat3f& radiance, const ColourModel& model,
                        const PixelNoise& noise) {
  const GammaCodes& table = GammaTable(model.gamma);
  const bool noisy = model.shot_variance > 0 || model.read_sigma > 0;
  const LightVariance variance{static_cast<float>(model.shot_variance),
                               static_cast<float>(model.read_sigma * model.read_sigma)};
  const double mid_u = 0.5 * (radiance.cols - 1), mid_v = 0.5 * (radiance.rows - 1);
  const double loss = model.corner_loss / std::max(1e-9, mid_u * mid_u + mid_v * mid_v);
  thread_local cv::Mat3b kept;
  thread_local Samples row;  // memory only
  cv::Mat3b image = Recycled(kept, radiance.size());
  row.Start(radiance.cols);
  for (int v = 0; v < radiance.rows; ++v) {
    if (noisy) row.Draw(noise, v);
    KeptLight(mid_u, mid_v, loss, v, radiance.cols, 3, row.kept.data());
    LightCodes(radiance.ptr<float>(v), row.kept.data(), row.normal.data(), variance, kCodes,
               3 * radiance.cols, row.codes.data());
    const std::int32_t* codes = row.codes.data();
    uchar* out = image.ptr(v);
    for (int u = 0; u < radiance.cols; ++u, codes += 3, out += 3) {
      for (int k = 0; k < 3; ++k) out[2 - k] = table[static_cast<std::size_t>(codes[k])];
    }
  }
  return image;
}

}  // namespace sim
