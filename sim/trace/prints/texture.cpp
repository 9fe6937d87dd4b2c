#include "sim/trace/prints/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "sim/trace/pixel_rows.h"
#include "sim/trace/prints/print.h"

namespace sim {
namespace {

constexpr int kMaxTaps = 4;         ///< along the longer side of a slanted footprint
constexpr float kMinBlend = 1e-3F;  ///< less of the coarser level is none

/// log2 to 0.09, from the bits alone: exactly the same everywhere.
float RoughLog2(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const float mantissa = std::bit_cast<float>((bits & 0x007FFFFFu) | 0x3F800000u);
  return static_cast<float>(static_cast<int>(bits >> 23) - 127) + mantissa - 1.0F;
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
    : material_(material),
      extent_m_(extent_m.cast<float>()),
      low_m_(low_m.cast<float>()),
      texel_m_(static_cast<float>(std::max(texel_m, extent_m.maxCoeff() / max_texels))) {
  int width = std::max(1, static_cast<int>(std::ceil(extent_m.x() / texel_m_)));
  int height = std::max(1, static_cast<int>(std::ceil(extent_m.y() / texel_m_)));
  for (;; width = (width + 1) / 2, height = (height + 1) / 2) {
    levels_.push_back({width, height, {}});
    levels_.back().Allocate();
    if (width == 1 && height == 1) break;
  }
}

void Texture::BakeRows(int first, int last) {
  Level& level = levels_.front();
  const auto middles = [&](int from, int to) {
    std::vector<float> places_m;
    for (int i = from; i < to; ++i)
      places_m.push_back((static_cast<float>(i) + 0.5F) * texel_m_);
    return places_m;
  };
  const std::vector<float> x_m = middles(0, level.width), y_m = middles(first, last);
  const std::vector<Eigen::Array3f> colours = Reflectance(material_, extent_m_, {x_m, y_m});
  static_assert(sizeof(Eigen::Array3f) == 3 * sizeof(float));
  std::vector<std::uint8_t> roots(3 * colours.size());
  RootBytes(colours.data()->data(), static_cast<int>(roots.size()), roots.data());
  const std::uint8_t* root = roots.data();
  for (int y = first; y < last; ++y) {
    Texel* texels = &level.At(0, y);
    for (int x = 0; x < level.width; ++x, root += 3) texels[x] = {root[0], root[1], root[2], 0};
  }
}

void Texture::Finish() {
  levels_.front().CopyBorder();
  for (std::size_t i = 1; i < levels_.size(); ++i) Halve(levels_[i - 1], levels_[i]);
}

void Texture::Halve(const Level& fine, Level& coarse) {
  // Where the fine image has an odd side, its border stands for the texel that lacks.
  for (int y = 0; y < coarse.height; ++y) {
    HalveTexels(fine.At(0, 2 * y).data(), fine.At(0, 2 * y + 1).data(), coarse.width,
                coarse.At(0, y).data());
  }
  coarse.CopyBorder();
}

TextureFootprint Texture::Footprint(const TextureSteps& steps) const {
  const float scale = 1.0F / texel_m_;
  const float right = steps.right_u * steps.right_u + steps.right_v * steps.right_v;
  const float down = steps.down_u * steps.down_u + steps.down_v * steps.down_v;
  // The pixel's footprint on the print is a parallelogram: its longer side is covered by taps,
  // its shorter one by the level.
  const bool wide = right > down;
  const float major = std::sqrt(wide ? right : down);
  const float area = std::abs(steps.right_u * steps.down_v - steps.right_v * steps.down_u);
  const float minor = std::max(area / std::max(major, 1e-12F), major / kMaxTaps);
  // The level whose texels are as large as the shorter side.
  const float last = static_cast<float>(levels_.size() - 1);
  const float lod = std::clamp(RoughLog2(std::max(minor * scale, 1e-6F)), 0.0F, last);
  TextureFootprint footprint;
  footprint.taps = std::clamp(static_cast<int>(major / minor + 0.5F), 1, kMaxTaps);
  footprint.level = static_cast<std::size_t>(lod);
  const float blend = lod - static_cast<float>(footprint.level);
  if (blend >= kMinBlend && footprint.level + 1 < levels_.size()) footprint.blend = blend;
  const float share = scale / static_cast<float>(footprint.taps);
  footprint.step_u = (wide ? steps.right_u : steps.down_u) * share;
  footprint.step_v = (wide ? steps.right_v : steps.down_v) * share;
  return footprint;
}

}  // namespace sim
