#include "sim/trace/print.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/trace/print_noise.h"

namespace sim {
namespace {

using Eigen::Array3f;
using Eigen::Vector2f;

/// A tint of the palette between base and ink, with some hue of its own.
Array3f Tint(const Array3f& base, const Array3f& ink, const CellDraw& draw, float strength) {
  const Array3f mixed = base + (ink - base) * draw[0];
  const Array3f hue(draw[1], draw[2], draw[3]);
  return mixed + (hue - mixed) * (0.55F * strength);
}

struct Palette {
  Array3f base, ink;
  float richness;
  std::uint64_t seed;
  Array3f Mixed(float amount) const { return base + (ink - base) * (amount * richness); }
};

Array3f Wood(const Palette& c, const Vector2f& p) {
  const Vector2f stretched(p.x() * 3.0F, p.y() * 40.0F);
  const float rings = ValueNoise(stretched, c.seed) * 0.6F +
                      ValueNoise(Vector2f(p.x() * 9.0F, p.y() * 160.0F), c.seed + 1) * 0.4F;
  const float fleck = std::max({Flecks(p, 0.006F, 0.16F, 2.5F, c.seed + 2),
                                Flecks(p, 0.016F, 0.22F, 2.0F, c.seed + 3),
                                0.8F * Flecks(p, 0.045F, 0.16F, 1.4F, c.seed + 4)});
  return c.Mixed(std::min(1.0F, 0.35F * rings + 0.75F * fleck));
}

Array3f Cloth(const Palette& c, const Vector2f& p) {
  const float thread = ValueNoise(Vector2f(p.x() * 500.0F, p.y() * 60.0F), c.seed) * 0.5F +
                       ValueNoise(Vector2f(p.x() * 60.0F, p.y() * 500.0F), c.seed + 1) * 0.5F;
  const float motif = std::max({Flecks(p, 0.012F, 0.3F, 1.0F, c.seed + 2),
                                Flecks(p, 0.030F, 0.3F, 1.0F, c.seed + 3),
                                Flecks(p, 0.085F, 0.25F, 1.0F, c.seed + 4)});
  return c.Mixed(std::min(1.0F, 0.25F * thread + 0.8F * motif));
}

Array3f Speckle(const Palette& c, const Vector2f& p) {
  const float dark = std::max({Flecks(p, 0.007F, 0.3F, 1.0F, c.seed),
                               Flecks(p, 0.018F, 0.35F, 1.0F, c.seed + 1),
                               Flecks(p, 0.050F, 0.3F, 1.0F, c.seed + 2)});
  const float light = Flecks(p, 0.014F, 0.2F, 1.0F, c.seed + 3);
  return c.Mixed(std::clamp(0.15F + 0.85F * dark - 0.15F * light, 0.0F, 1.0F));
}

Array3f Text(const Palette& c, const Vector2f& p, const Vector2f& extent) {
  const float fine = TextInk(p, 0.0075F, extent.x(), c.seed);
  // Headings and figures, one band in five: what is left to see from afar.
  const float band_m = 0.055F;
  const int band = FloorOf(p.y() / band_m);
  const CellDraw draw(band, 3, c.seed + 5);
  if (draw[0] < 0.4F) {
    const Vector2f q(p.x(), p.y() - static_cast<float>(band) * band_m);
    if (q.y() < 0.03F) {
      if (draw[1] < 0.5F)
        return c.Mixed(TextInk(q, 0.03F, extent.x(),
                               c.seed + 11 * (static_cast<std::uint64_t>(band) + 9)));
      const int cell = FloorOf(p.x() / 0.02F);
      const CellDraw bar(cell, band, c.seed + 6);
      return c.Mixed(q.y() < 0.03F * bar[0] ? 0.3F + 0.6F * bar[1] : 0.05F);
    }
  }
  return c.Mixed(0.92F * fine);
}

/// Splits the face into blocks three times, each along its longer side; returns the draw of the
/// block that holds p and p's place in it.
CellDraw Block(Vector2f& p, Vector2f& size, float smallest_m, std::uint64_t seed) {
  std::uint64_t name = seed;
  for (int depth = 0; depth < 5; ++depth) {
    const CellDraw draw(depth, 0, name);
    const int axis = size.x() > size.y() ? 0 : 1;
    if (size[axis] < 2.2F * smallest_m || (depth > 2 && draw[1] < 0.35F)) break;
    const float cut = size[axis] * (0.3F + 0.4F * draw[0]);
    const bool upper = p[axis] >= cut;
    if (upper) p[axis] -= cut;
    size[axis] = upper ? size[axis] - cut : cut;
    name = MixBits(name + (upper ? 0x51ull : 0xA3ull) + static_cast<std::uint64_t>(depth));
  }
  return CellDraw(1, 2, name);
}

Array3f Cover(const Palette& c, const PrintSpot& spot) {
  Vector2f p = spot.p_m, size = spot.extent_m;
  const CellDraw block = Block(p, size, 0.03F, c.seed);
  const Array3f ground = Tint(c.base, c.ink, block, c.richness);
  const Array3f mark =
      ground.mean() > 0.3F ? Array3f(ground * 0.12F) : Array3f(0.75F * (1.0F - ground) + 0.2F);
  const CellDraw kind(3, 4, block.bits);
  float cover = 0;
  if (kind[0] < 0.55F) {  // lettering, sized to the block
    const float line = std::clamp(size.y() * (0.25F + 0.6F * kind[1]), 0.006F, 0.06F);
    cover = TextInk(p, line, size.x(), block.bits);
  } else if (kind[0] < 0.8F) {
    cover = std::max(Flecks(p, 0.010F, 0.45F, 1.0F, block.bits),
                     Flecks(p, 0.030F, 0.4F, 1.0F, block.bits + 1));
  } else {
    cover = TextInk(p, 0.008F, size.x(), block.bits);
  }
  // Scuffs over everything, so that no block is bare.
  const float scuff = Flecks(spot.p_m, 0.012F, 0.14F, 1.3F, c.seed + 9);
  const Array3f printed = ground + (mark - ground) * std::max(cover, 0.6F * scuff);
  return c.base + (printed - c.base) * c.richness;
}

Array3f Keys(const Palette& c, const PrintSpot& spot) {
  constexpr float kPitch_m = 0.01905F;
  const float margin = 0.006F;
  const Vector2f p = spot.p_m - Vector2f(margin, margin);
  const Array3f frame = c.base * 0.55F;
  if (p.x() < 0 || p.y() < 0 || p.x() > spot.extent_m.x() - 2 * margin ||
      p.y() > spot.extent_m.y() - 2 * margin) {
    return frame +
           (c.ink - frame) * (0.7F * c.richness * Flecks(spot.p_m, 0.011F, 0.2F, 2.0F, c.seed));
  }
  const int row = FloorOf(p.y() / kPitch_m);
  const float shift = 0.25F * static_cast<float>(row);  // rows are staggered
  const float along = p.x() / kPitch_m + shift;
  const int column = FloorOf(along);
  const CellDraw key(column, row, c.seed);
  const Vector2f q(along - static_cast<float>(column),
                   p.y() / kPitch_m - static_cast<float>(row));
  const float rim = std::min({q.x(), 1 - q.x(), q.y(), 1 - q.y()});
  if (rim < 0.07F) return c.base * (1.0F - 0.75F * c.richness);
  const Array3f cap = key[3] < 0.18F ? Array3f(c.base * 0.6F + 0.12F) : c.base;
  const Vector2f legend((q.x() - 0.2F) / 0.45F, (q.y() - 0.18F) / 0.6F);
  const bool inked = Glyph(legend, key.bits >> 7);
  return inked ? Array3f(cap + (c.ink - cap) * c.richness) : cap;
}

Array3f Screen(const Palette& c, const PrintSpot& spot) {
  Vector2f p = spot.p_m, size = spot.extent_m;
  const float bezel = 0.012F;
  const Vector2f inner = spot.extent_m - Vector2f(2 * bezel, 2 * bezel);
  if (inner.minCoeff() <= 0 || (p.array() < bezel).any() ||
      ((spot.extent_m - p).array() < bezel).any()) {
    return c.base * 0.25F;
  }
  p -= Vector2f(bezel, bezel);
  size = inner;
  const CellDraw window = Block(p, size, 0.06F, c.seed);
  const Array3f ground = Tint(c.base, c.ink, window, 0.8F * c.richness);
  const Array3f mark =
      ground.mean() > 0.3F ? Array3f(ground * 0.15F) : Array3f(0.65F * (1.0F - ground) + 0.2F);
  if (p.y() > size.y() - 0.008F) return mark * 0.7F + ground * 0.3F;  // title bar
  const CellDraw kind(5, 6, window.bits);
  float cover = 0;
  if (kind[0] < 0.6F) {
    cover = TextInk(p, 0.009F + 0.012F * kind[1], size.x(), window.bits);
  } else {
    cover = std::max(Flecks(p, 0.012F, 0.4F, 1.0F, window.bits),
                     Flecks(p, 0.035F, 0.4F, 1.0F, window.bits + 1));
  }
  const Array3f shown = ground + (mark - ground) * cover;
  return c.base + (shown - c.base) * c.richness;
}

Array3f Printed(const Material& material, const PrintSpot& spot) {
  const auto colour = [](const std::array<double, 3>& rgb) {
    return Array3f(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                   static_cast<float>(rgb[2]));
  };
  const Palette c{colour(material.colour), colour(material.ink),
                  static_cast<float>(std::clamp(material.richness, 0.0, 1.0)),
                  MixBits(material.seed)};
  switch (material.print) {
    case Print::kWood:
      return Wood(c, spot.p_m);
    case Print::kCloth:
      return Cloth(c, spot.p_m);
    case Print::kText:
      return Text(c, spot.p_m, spot.extent_m);
    case Print::kCover:
      return Cover(c, spot);
    case Print::kKeys:
      return Keys(c, spot);
    case Print::kScreen:
      return Screen(c, spot);
    case Print::kSpeckle:
      return Speckle(c, spot.p_m);
    case Print::kPlain:
      break;
  }
  return c.base;
}

}  // namespace

Eigen::Array3f Reflectance(const Material& material, const PrintSpot& spot) {
  return Printed(material, spot).max(0.0F).min(1.0F);
}

}  // namespace sim
