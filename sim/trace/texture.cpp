#include "sim/trace/texture.h"

#include <emmintrin.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/trace/print.h"

namespace sim {
namespace {

constexpr int kMaxTaps = 4;           ///< along the longer side of a slanted footprint
constexpr float kLeastBlend = 1e-3F;  ///< less of the coarser level is none
constexpr int kOne = 1 << 14;         ///< weight 1 in whole numbers

/// log2 to 0.09, from the bits alone: exactly the same everywhere.
float RoughLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float mantissa = std::bit_cast<float>((bits & 0x007FFFFFu) | 0x3F800000u);
  return static_cast<float>(static_cast<int>(bits >> 23) - 127) + mantissa - 1.0F;
}

/// Four neighbouring texels mixed, times kOne. Pairs of texels lie side by side in memory.
inline __m128 Between(const std::uint8_t* upper, const std::uint8_t* lower, float tx,
                      float ty) {
  const int right = static_cast<int>(tx * kOne + 0.5F);
  const __m128i weights = _mm_set1_epi32((right << 16) | (kOne - right));
  const auto mixed = [&](const std::uint8_t* pair) {
    const __m128i bytes = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(pair));
    const __m128i words = _mm_unpacklo_epi8(bytes, _mm_setzero_si128());
    const __m128i pairs = _mm_unpacklo_epi16(words, _mm_srli_si128(words, 8));
    return _mm_cvtepi32_ps(_mm_madd_epi16(pairs, weights));
  };
  const __m128 high = mixed(upper), low = mixed(lower);
  return _mm_add_ps(high, _mm_mul_ps(_mm_sub_ps(low, high), _mm_set1_ps(ty)));
}

}  // namespace

void Texture::Level::Allocate() {
  texels.resize(static_cast<std::size_t>(width + 1) * static_cast<std::size_t>(height + 1));
}

void Texture::Level::CopyBorder() {
  for (int y = 0; y < height; ++y) At(width, y) = At(width - 1, y);
  for (int x = 0; x <= width; ++x) At(x, height) = At(x, height - 1);
}

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
  level.Allocate();
  const Eigen::Vector2f extent = extent_m.cast<float>();
  for (int y = 0; y < level.height; ++y) {
    for (int x = 0; x < level.width; ++x) {
      const Eigen::Vector2f p((static_cast<float>(x) + 0.5F) * texel_m_,
                              (static_cast<float>(y) + 0.5F) * texel_m_);
      const Eigen::Array3f colour = Reflectance(material, {p, extent});
      for (int channel = 0; channel < 3; ++channel) {
        level.At(x, y)[static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::sqrt(colour[channel]) * 255.0F + 0.5F);
      }
    }
  }
  level.CopyBorder();
}

void Texture::Halve() {
  const Level& fine = levels_.back();
  Level coarse;
  coarse.width = (fine.width + 1) / 2;
  coarse.height = (fine.height + 1) / 2;
  coarse.Allocate();
  const auto fine_at = [&](int x, int y) -> const Texel& {
    return fine.At(std::min(x, fine.width - 1), std::min(y, fine.height - 1));
  };
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
          const float root = fine_at(2 * x + (k & 1), 2 * y + (k >> 1))[channel];
          sum += root * root;
        }
        coarse.At(x, y)[channel] = static_cast<std::uint8_t>(std::sqrt(0.25F * sum) + 0.5F);
      }
    }
  }
  coarse.CopyBorder();
  levels_.push_back(std::move(coarse));
}

TextureFootprint Texture::Footprint(const TextureSteps& steps) const {
  const float scale = 1.0F / texel_m_;
  const float right = steps.right_u * steps.right_u + steps.right_v * steps.right_v;
  const float down = steps.down_u * steps.down_u + steps.down_v * steps.down_v;
  const bool wide = right > down;
  const float major = std::sqrt(wide ? right : down);
  const float area = std::abs(steps.right_u * steps.down_v - steps.right_v * steps.down_u);
  const float minor = std::max(area / std::max(major, 1e-12F), major / kMaxTaps);
  const float last = static_cast<float>(levels_.size() - 1);
  const float lod = std::clamp(RoughLog2(std::max(minor * scale, 1e-6F)), 0.0F, last);
  TextureFootprint footprint;
  footprint.taps = std::clamp(static_cast<int>(major / minor + 0.5F), 1, kMaxTaps);
  footprint.level = static_cast<std::size_t>(lod);
  const float blend = lod - static_cast<float>(footprint.level);
  if (blend >= kLeastBlend && footprint.level + 1 < levels_.size()) footprint.blend = blend;
  const float share = scale / static_cast<float>(footprint.taps);
  footprint.step_u = (wide ? steps.right_u : steps.down_u) * share;
  footprint.step_v = (wide ? steps.right_v : steps.down_v) * share;
  return footprint;
}

std::array<float, 4> Texture::Sample(float u_m, float v_m,
                                     const TextureFootprint& footprint) const {
  const float scale = 1.0F / texel_m_;
  const float middle = 0.5F * static_cast<float>(footprint.taps - 1);
  const float first_u = (u_m - low_m_.x()) * scale - middle * footprint.step_u;
  const float first_v = (v_m - low_m_.y()) * scale - middle * footprint.step_v;
  const auto sum_of = [&](std::size_t index) {
    const Level& level = levels_[index];
    const float size = 1.0F / static_cast<float>(1u << index);
    const float last_x = static_cast<float>(level.width - 1);
    const float last_y = static_cast<float>(level.height - 1);
    const std::size_t row = static_cast<std::size_t>(level.width + 1);
    __m128 sum = _mm_setzero_ps();
    for (int k = 0; k < footprint.taps; ++k) {
      const auto along = static_cast<float>(k);
      const float x =
          std::min(std::max((first_u + along * footprint.step_u) * size - 0.5F, 0.0F), last_x);
      const float y =
          std::min(std::max((first_v + along * footprint.step_v) * size - 0.5F, 0.0F), last_y);
      const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
      const Texel* texel = level.texels.data() + static_cast<std::size_t>(y0) * row +
                           static_cast<std::size_t>(x0);
      sum = _mm_add_ps(sum, Between(texel->data(), texel[row].data(),
                                    x - static_cast<float>(x0), y - static_cast<float>(y0)));
    }
    return sum;
  };
  __m128 root = sum_of(footprint.level);
  if (footprint.blend > 0) {
    const __m128 coarse = sum_of(footprint.level + 1);
    root = _mm_add_ps(root, _mm_mul_ps(_mm_sub_ps(coarse, root), _mm_set1_ps(footprint.blend)));
  }
  const float share = 1.0F / static_cast<float>(footprint.taps);
  root = _mm_mul_ps(root, _mm_set1_ps(share / (255.0F * kOne)));
  std::array<float, 4> colour;
  _mm_storeu_ps(colour.data(), _mm_mul_ps(root, root));
  return colour;
}

}  // namespace sim
