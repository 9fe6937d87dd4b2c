#include "sim/sensor/depth_effects.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sim {

namespace {

/// Sums of `side` neighbours in a row of `white`, side - 1 longer than `sums`.
void SumAcross(const float* white, int side, int width, float* sums) {
  for (int u = 0; u < width; ++u) sums[u] = white[u];
  for (int i = 1; i < side; ++i) {
    for (int u = 0; u < width; ++u) sums[u] += white[u + i];
  }
}

void SumDown(const cv::Mat1f& across, int side, cv::Mat1f& smooth) {
  const float scale = 1.0F / static_cast<float>(side);
  for (int v = 0; v < smooth.rows; ++v) {
    float* out = smooth[v];
    const float* first = across[v];
    for (int u = 0; u < smooth.cols; ++u) out[u] = first[u];
    for (int i = 1; i < side; ++i) {
      const float* row = across[v + i];
      for (int u = 0; u < smooth.cols; ++u) out[u] += row[u];
    }
    for (int u = 0; u < smooth.cols; ++u) out[u] *= scale;
  }
}

}  // namespace

void SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise, std::uint32_t first,
                 std::span<cv::Mat1f> images) {
  thread_local std::vector<cv::Mat1f> across;
  thread_local std::vector<float> white;
  const int side = 2 * radius + 1, width = size.width + 2 * radius;
  const auto padded = static_cast<std::size_t>(width);
  across.resize(std::max(across.size(), images.size()));
  white.resize(padded * images.size());
  for (cv::Mat1f& sums : std::span(across).first(images.size())) {
    sums.create(size.height + 2 * radius, size.width);
  }
  for (int v = 0; v < size.height + 2 * radius; ++v) {
    for (int u = 0; u < width; ++u) {
      std::uint64_t bits = noise.NormalBits(u - radius, v - radius, first);
      for (std::uint32_t k = 0; k < images.size(); ++k) {
        const std::uint32_t draw = first + k;
        if (k > 0 && draw % 4 == 0) bits = noise.NormalBits(u - radius, v - radius, draw);
        white[k * padded + static_cast<std::size_t>(u)] = PixelNoise::NormalOf(bits, draw);
      }
    }
    for (std::size_t k = 0; k < images.size(); ++k) {
      SumAcross(white.data() + k * padded, side, size.width, across[k][v]);
    }
  }
  for (std::size_t k = 0; k < images.size(); ++k) {
    images[k].create(size);
    SumDown(across[k], side, images[k]);
  }
}

cv::Mat1f SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise,
                      std::uint32_t draw) {
  cv::Mat1f image;
  SmoothNoise(size, radius, noise, draw, std::span(&image, 1));
  return image;
}

double Incidence(float cosine) {
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

bool SameSurface(const Rendering& rendering, cv::Point a, cv::Point b) {
  return rendering.plane_id(a) == rendering.plane_id(b) &&
         rendering.object_id(a) == rendering.object_id(b);
}

double RoundDepth(double z_m, double step_m) {
  return step_m > 0 ? step_m * std::floor(z_m / step_m + 0.5) : z_m;
}

double SigmaBeforeRounding(double sigma, double step_a, double step_b) {
  const double rounding = (step_a * step_a + step_b * step_b) / 12.0;
  const double least = std::max(step_a, step_b) / 6.0;
  return std::sqrt(std::max(sigma * sigma - rounding, least * least));
}

}  // namespace sim
