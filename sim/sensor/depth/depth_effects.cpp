#include "sim/sensor/depth/depth_effects.h"

namespace sim {

void SmoothNoiseRows::Start(int width, int radius, const PixelNoise& noise,
                            std::uint32_t first_draw, std::size_t draws) {
  noise_ = noise;
  radius_ = radius;
  row_ = -1;
  first_draw_ = first_draw;
  draws_ = draws;
  width_ = static_cast<std::size_t>(width);
  side_ = static_cast<std::size_t>(2 * radius + 1);
  const std::size_t padded = width_ + side_ - 1;
  bits_.resize(padded);
  white_.resize(padded);
  smooth_.resize(draws_ * width_);
  across_.resize(side_ * draws_ * width_);
  for (int v = -radius; v < radius; ++v) AddRow(v);
}

float* SmoothNoiseRows::Across(int v, std::size_t k) {
  const std::size_t slot = static_cast<std::size_t>(v + radius_) % side_;
  return across_.data() + (slot * draws_ + k) * width_;
}

/// Sums of `side` neighbours along one row of white noise.
void SmoothNoiseRows::AddRow(int v) {
  for (std::size_t k = 0; k < draws_; ++k) {
    const std::uint32_t draw = first_draw_ + static_cast<std::uint32_t>(k);
    if (k == 0 || draw % 4 == 0) noise_.NormalBitsOfRow(-radius_, v, draw, bits_);
    PixelNoise::NormalsOf(bits_, draw, 1, white_.data());
    float* sums = Across(v, k);
    std::copy_n(white_.data(), width_, sums);
    for (std::size_t i = 1; i < side_; ++i) {
      for (std::size_t u = 0; u < width_; ++u) sums[u] += white_[u + i];
    }
  }
}

void SmoothNoiseRows::Next() {
  ++row_;
  AddRow(row_ + radius_);
  // The mean over side x side pixels, scaled back to unit variance: the root of their number.
  const float scale = 1.0F / static_cast<float>(side_);
  for (std::size_t k = 0; k < draws_; ++k) {
    float* out = smooth_.data() + k * width_;
    std::copy_n(Across(row_ - radius_, k), width_, out);
    for (int v = row_ - radius_ + 1; v <= row_ + radius_; ++v) {
      const float* sums = Across(v, k);
      for (std::size_t u = 0; u < width_; ++u) out[u] += sums[u];
    }
    for (std::size_t u = 0; u < width_; ++u) out[u] *= scale;
  }
}

cv::Mat1f SmoothNoise(const cv::Size& size, int radius, const PixelNoise& noise,
                      std::uint32_t draw) {
  cv::Mat1f image(size);
  SmoothNoiseRows rows;
  rows.Start(size.width, radius, noise, draw, 1);
  for (int v = 0; v < size.height; ++v) {
    rows.Next();
    std::copy_n(rows.Row(0), size.width, image[v]);
  }
  return image;
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
