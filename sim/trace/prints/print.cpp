#include "sim/trace/prints/print.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "sim/trace/prints/print_blocks.h"

namespace sim {
namespace {

using Eigen::Array3f;
using Eigen::Vector2f;
using Colours = std::vector<Array3f>;

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

/// Raises values to `share` times the others of the same places, where that is more.
void RaiseTo(const std::vector<float>& others, float share, std::vector<float>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = std::max(values[i], share * others[i]);
  }
}

Colours Wood(const Palette& c, const PrintGrid& grid) {
  const auto coarse = ValueNoise(grid, {3.0F, 40.0F}, c.seed);
  const auto fine = ValueNoise(grid, {9.0F, 160.0F}, c.seed + 1);
  auto fleck = Flecks(grid, {0.006F, 0.16F, 2.5F}, c.seed + 2);
  RaiseTo(Flecks(grid, {0.016F, 0.22F, 2.0F}, c.seed + 3), 1.0F, fleck);
  RaiseTo(Flecks(grid, {0.045F, 0.16F, 1.4F}, c.seed + 4), 0.8F, fleck);
  Colours colours(grid.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float rings = coarse[i] * 0.6F + fine[i] * 0.4F;
    colours[i] = c.Mixed(std::min(1.0F, 0.35F * rings + 0.75F * fleck[i]));
  }
  return colours;
}

Colours Cloth(const Palette& c, const PrintGrid& grid) {
  const auto warp = ValueNoise(grid, {500.0F, 60.0F}, c.seed);
  const auto weft = ValueNoise(grid, {60.0F, 500.0F}, c.seed + 1);
  auto motif = Flecks(grid, {0.012F, 0.3F, 1.0F}, c.seed + 2);
  RaiseTo(Flecks(grid, {0.030F, 0.3F, 1.0F}, c.seed + 3), 1.0F, motif);
  RaiseTo(Flecks(grid, {0.085F, 0.25F, 1.0F}, c.seed + 4), 1.0F, motif);
  Colours colours(grid.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const float thread = warp[i] * 0.5F + weft[i] * 0.5F;
    colours[i] = c.Mixed(std::min(1.0F, 0.25F * thread + 0.8F * motif[i]));
  }
  return colours;
}

Colours Speckle(const Palette& c, const PrintGrid& grid) {
  auto dark = Flecks(grid, {0.007F, 0.3F, 1.0F}, c.seed);
  RaiseTo(Flecks(grid, {0.018F, 0.35F, 1.0F}, c.seed + 1), 1.0F, dark);
  RaiseTo(Flecks(grid, {0.050F, 0.3F, 1.0F}, c.seed + 2), 1.0F, dark);
  const auto light = Flecks(grid, {0.014F, 0.2F, 1.0F}, c.seed + 3);
  Colours colours(grid.size());
  for (std::size_t i = 0; i < colours.size(); ++i) {
    colours[i] = c.Mixed(std::clamp(0.15F + 0.85F * dark[i] - 0.15F * light[i], 0.0F, 1.0F));
  }
  return colours;
}

/// The rows of text that are no running text: a heading, or bars of a figure.
void PutHeading(const Palette& c, const PrintGrid& grid, float width_m, std::size_t row,
                Array3f* colours) {
  const float band_m = 0.055F;
  const float y_m = grid.y_m[row];
  const int band = FloorOf(y_m / band_m);
  const CellDraw draw(band, 3, c.seed + 5);
  const float in_band_m = y_m - static_cast<float>(band) * band_m;
  if (!(draw[0] < 0.4F && in_band_m < 0.03F)) return;
  if (draw[1] < 0.5F) {
    const auto ink = TextInk({grid.x_m, {&in_band_m, 1}}, 0.03F, width_m,
                             c.seed + 11 * (static_cast<std::uint64_t>(band) + 9));
    std::transform(ink.begin(), ink.end(), colours, [&](float i) { return c.Mixed(i); });
    return;
  }
  for (const float x_m : grid.x_m) {
    const CellDraw bar(FloorOf(x_m / 0.02F), band, c.seed + 6);
    *colours++ = c.Mixed(in_band_m < 0.03F * bar[0] ? 0.3F + 0.6F * bar[1] : 0.05F);
  }
}

Colours Text(const Palette& c, const PrintGrid& grid, const Vector2f& extent) {
  const auto fine = TextInk(grid, 0.0075F, extent.x(), c.seed);
  Colours colours(grid.size());
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = c.Mixed(0.92F * fine[i]);
  // Headings and figures, two bands in five: what is left to see from afar.
  for (std::size_t row = 0; row < grid.y_m.size(); ++row) {
    PutHeading(c, grid, extent.x(), row, colours.data() + row * grid.x_m.size());
  }
  return colours;
}

/// What is printed on a block of a cover: lettering sized to it, marks, or small print.
std::vector<float> CoverInk(const PrintBlock& block) {
  const PrintGrid grid = block.Grid();
  const std::uint64_t bits = block.draw.bits;
  const CellDraw kind(3, 4, bits);
  if (kind[0] < 0.55F) {
    const float line = std::clamp(block.size_m.y() * (0.25F + 0.6F * kind[1]), 0.006F, 0.06F);
    return TextInk(grid, line, block.size_m.x(), bits);
  }
  if (kind[0] < 0.8F) {
    auto marks = Flecks(grid, {0.010F, 0.45F, 1.0F}, bits);
    RaiseTo(Flecks(grid, {0.030F, 0.4F, 1.0F}, bits + 1), 1.0F, marks);
    return marks;
  }
  return TextInk(grid, 0.008F, block.size_m.x(), bits);
}

Colours Cover(const Palette& c, const PrintGrid& grid, const Vector2f& extent) {
  // Scuffs over everything, so that no block is bare.
  const auto scuffs = Flecks(grid, {0.012F, 0.14F, 1.3F}, c.seed + 9);
  Colours colours(grid.size());
  for (const PrintBlock& block : BlocksOf(grid, extent, 0.03F, c.seed)) {
    const Array3f ground = Tint(c.base, c.ink, block.draw, c.richness);
    const Array3f mark = ground.mean() > 0.3F ? Array3f(ground * 0.12F)
                                              : Array3f(0.75F * (1.0F - ground) + 0.2F);
    const auto cover = CoverInk(block);
    block.ForEachPlace(grid, [&](std::size_t own, std::size_t place) {
      const Array3f printed =
          ground + (mark - ground) * std::max(cover[own], 0.6F * scuffs[place]);
      colours[place] = c.base + (printed - c.base) * c.richness;
    });
  }
  return colours;
}

/// A key's colour where p is, from the first key's corner.
Array3f Key(const Palette& c, const Vector2f& p) {
  constexpr float kPitch_m = 0.01905F;
  const int row = FloorOf(p.y() / kPitch_m);
  const float shift = 0.25F * static_cast<float>(row);  // rows are staggered
  const float along = p.x() / kPitch_m + shift;
  const int column = FloorOf(along);
  const CellDraw key(column, row, c.seed);
  const Vector2f q(along - static_cast<float>(column),
                   p.y() / kPitch_m - static_cast<float>(row));
  const float rim = std::min({q.x(), 1 - q.x(), q.y(), 1 - q.y()});
  if (rim < 0.07F) return c.base * (1.0F - 0.75F * c.richness);
  // Some caps are of another colour.
  const Array3f cap =
      key[3] < 0.18F ? Array3f(c.base + (0.12F - 0.4F * c.base) * c.richness) : c.base;
  const Vector2f legend((q.x() - 0.2F) / 0.45F, (q.y() - 0.18F) / 0.6F);
  const bool inked = Glyph(legend, key.bits >> 7);
  return inked ? Array3f(cap + (c.ink - cap) * c.richness) : cap;
}

Colours Keys(const Palette& c, const PrintGrid& grid, const Vector2f& extent) {
  const float margin = 0.006F;
  const Array3f frame = c.base * (1.0F - 0.45F * c.richness);
  const auto dust = Flecks(grid, {0.011F, 0.2F, 2.0F}, c.seed);
  Colours colours;
  colours.reserve(grid.size());
  for (const float y_m : grid.y_m) {
    for (const float x_m : grid.x_m) {
      const Vector2f p = Vector2f(x_m, y_m) - Vector2f(margin, margin);
      if (p.x() < 0 || p.y() < 0 || p.x() > extent.x() - 2 * margin ||
          p.y() > extent.y() - 2 * margin) {
        colours.push_back(frame + (c.ink - frame) * (0.7F * c.richness * dust[colours.size()]));
      } else {
        colours.push_back(Key(c, p));
      }
    }
  }
  return colours;
}

/// What a window on a screen shows: text, or marks.
std::vector<float> WindowInk(const PrintBlock& window) {
  const PrintGrid grid = window.Grid();
  const std::uint64_t bits = window.draw.bits;
  const CellDraw kind(5, 6, bits);
  if (kind[0] < 0.6F) return TextInk(grid, 0.009F + 0.012F * kind[1], window.size_m.x(), bits);
  auto marks = Flecks(grid, {0.012F, 0.4F, 1.0F}, bits);
  RaiseTo(Flecks(grid, {0.035F, 0.4F, 1.0F}, bits + 1), 1.0F, marks);
  return marks;
}

Colours Screen(const Palette& c, const PrintGrid& grid, const Vector2f& extent) {
  const float bezel = 0.012F;
  const Vector2f inner = extent - Vector2f(2 * bezel, 2 * bezel);
  Colours colours(grid.size(), c.base * (1.0F - 0.75F * c.richness));
  if (inner.minCoeff() <= 0) return colours;
  for (const PrintBlock& window : BlocksInside(grid, extent, bezel, 0.06F, c.seed)) {
    const Array3f ground = Tint(c.base, c.ink, window.draw, 0.8F * c.richness);
    const Array3f mark = ground.mean() > 0.3F ? Array3f(ground * 0.15F)
                                              : Array3f(0.65F * (1.0F - ground) + 0.2F);
    const auto cover = WindowInk(window);
    window.ForEachPlace(grid, [&](std::size_t own, std::size_t place) {
      const float y_m = window.y_m[own / window.x_m.size()];
      const bool title_bar = y_m > window.size_m.y() - 0.008F;
      const Array3f shown = ground + (mark - ground) * (title_bar ? 0.7F : cover[own]);
      colours[place] = c.base + (shown - c.base) * c.richness;
    });
  }
  return colours;
}

Colours Printed(const Material& material, const Vector2f& extent, const PrintGrid& grid) {
  const auto colour = [](const std::array<double, 3>& rgb) {
    return Array3f(static_cast<float>(rgb[0]), static_cast<float>(rgb[1]),
                   static_cast<float>(rgb[2]));
  };
  const Palette c{colour(material.colour), colour(material.ink),
                  static_cast<float>(std::clamp(material.richness, 0.0, 1.0)),
                  MixBits(material.seed)};
  switch (material.print) {
    case Print::kWood:
      return Wood(c, grid);
    case Print::kCloth:
      return Cloth(c, grid);
    case Print::kText:
      return Text(c, grid, extent);
    case Print::kCover:
      return Cover(c, grid, extent);
    case Print::kKeys:
      return Keys(c, grid, extent);
    case Print::kScreen:
      return Screen(c, grid, extent);
    case Print::kSpeckle:
      return Speckle(c, grid);
    case Print::kPlain:
      break;
  }
  return Colours(grid.size(), c.base);
}

}  // namespace

std::vector<Array3f> Reflectance(const Material& material, const Vector2f& extent_m,
                                 const PrintGrid& grid) {
  Colours colours = Printed(material, extent_m, grid);
  for (Array3f& colour : colours) colour = colour.max(0.0F).min(1.0F);
  return colours;
}

}  // namespace sim
