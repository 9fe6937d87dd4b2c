#include "sim/trace/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/trace/print.h"

namespace sim {
namespace {

constexpr int kMaxTaps = 4;  ///< along the longer side of a slanted footprint

/// log2 to 0.09, from the bits alone: exactly the same everywhere.
float RoughLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float mantissa = std::bit_cast<float>((bits & 0x007FFFFFu) | 0x3F800000u);
  return static_cast<float>(static_cast<int>(bits >> 23) - 127) + mantissa - 1.0F;
}

}  // namespace

Texture::Texture(const Material& material, const Eigen::Vector2d& low_m,
                 const Eigen::Vector2d& extent_m, double texel_m, int max_texels)
    : low_m_(low_m.cast<float>()),
      texel_m_(static_cast<float>(std::max(texel_m, extent_m.maxCoeff() / max_texels))) {
  Level finest;
  finest.width = std::max(1, static_cast<int>(std::ceil(extent_m.x() / texel_m_)));
  finest.height = std::max(1, static_cast<int>(std::ceil(extent_m.y() / texel_m_)));
  levels_.push_back(std::move(finest));
  Bake(material, extent_m);
  while (levels_.back().width > 1 || levels_.back().height > 1) Halve();
}

void Texture::Bake(const Material& material, const Eigen::Vector2d& extent_m) {
  Level& level = levels_.front();
  level.texels.resize(static_cast<std::size_t>(level.width) *
                      static_cast<std::size_t>(level.height));
  const Eigen::Vector2f extent = extent_m.cast<float>();
  auto texel = level.texels.begin();
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x, ++texel) {
      const Eigen::Vector2f p((static_cast<float>(x) + 0.5F) * texel_m_,
                              (static_cast<float>(y) + 0.5F) * texel_m_);
      const Eigen::Array3f colour = Reflectance(material, {p, extent});
      for (int channel = 0; channel < 3; ++channel) {
        (*texel)[static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::sqrt(colour[channel]) * 255.0F + 0.5F);
      }
    }
  }
}

void Texture::Halve() {
  const Level& fine = levels_.back();
  Level coarse;
  coarse.width = (fine.width + 1) / 2;
  coarse.height = (fine.height + 1) / 2;
  coarse.texels.resize(static_cast<std::size_t>(coarse.width) *
                       static_cast<std::size_t>(coarse.height));
  const auto fine_at = [&](int x, int y) -> const Texel& {
    return fine.texels[static_cast<std::size_t>(std::min(y, fine.height - 1)) *
                           static_cast<std::size_t>(fine.width) +
                       static_cast<std::size_t>(std::min(x, fine.width - 1))];
  };
  auto texel = coarse.texels.begin();
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x, ++texel) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
          const float root = fine_at(2 * x + (k & 1), 2 * y + (k >> 1))[channel];
          sum += root * root;
        }
        (*texel)[channel] = static_cast<std::uint8_t>(std::sqrt(0.25F * sum) + 0.5F);
      }
    }
  }
  levels_.push_back(std::move(coarse));
}

Eigen::Array4f Texture::Bilinear(std::size_t index, const Eigen::Vector2f& texel) const {
  const Level& level = levels_[index];
  const float scale = 1.0F / static_cast<float>(1 << index);
  const float x =
      std::clamp(texel.x() * scale - 0.5F, 0.0F, static_cast<float>(level.width - 1));
  const float y =
      std::clamp(texel.y() * scale - 0.5F, 0.0F, static_cast<float>(level.height - 1));
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, level.width - 1), y1 = std::min(y0 + 1, level.height - 1);
  const float tx = x - static_cast<float>(x0), ty = y - static_cast<float>(y0);
  const auto at = [&](int i, int j) {
    const Texel& t =
        level.texels[static_cast<std::size_t>(j) * static_cast<std::size_t>(level.width) +
                     static_cast<std::size_t>(i)];
    return Eigen::Array4f(t[0], t[1], t[2], t[3]);
  };
  const Eigen::Array4f low = at(x0, y0) * (1 - tx) + at(x1, y0) * tx;
  const Eigen::Array4f high = at(x0, y1) * (1 - tx) + at(x1, y1) * tx;
  return low * (1 - ty) + high * ty;
}

Eigen::Array4f Texture::Trilinear(const Eigen::Vector2f& texel, float log2_footprint) const {
  const auto last = static_cast<float>(levels_.size() - 1);
  const float lod = std::clamp(log2_footprint, 0.0F, last);
  const auto fine = static_cast<std::size_t>(lod);
  const float blend = lod - static_cast<float>(fine);
  if (blend < 1e-3F || fine + 1 >= levels_.size()) return Bilinear(fine, texel);
  return Bilinear(fine, texel) * (1 - blend) + Bilinear(fine + 1, texel) * blend;
}

Eigen::Array3f Texture::Sample(const Eigen::Vector2f& uv_m, const Eigen::Vector2f& right_m,
                               const Eigen::Vector2f& down_m) const {
  const Eigen::Vector2f texel = (uv_m - low_m_) / texel_m_;
  const float right = right_m.squaredNorm(), down = down_m.squaredNorm();
  const Eigen::Vector2f& longer = right > down ? right_m : down_m;
  const float major = std::sqrt(std::max(right, down));
  const float area = std::abs(right_m.x() * down_m.y() - right_m.y() * down_m.x());
  const float minor = std::max(area / std::max(major, 1e-12F), major / kMaxTaps);
  const float lod = RoughLog2(std::max(minor / texel_m_, 1e-6F));
  const int taps = std::clamp(static_cast<int>(major / minor + 0.5F), 1, kMaxTaps);
  Eigen::Array4f root = Eigen::Array4f::Zero();
  for (int k = 0; k < taps; ++k) {
    const float offset = (static_cast<float>(k) + 0.5F) / static_cast<float>(taps) - 0.5F;
    root += Trilinear(texel + longer * (offset / texel_m_), lod);
  }
  root /= 255.0F * static_cast<float>(taps);
  return (root * root).head<3>();
}

}  // namespace sim
