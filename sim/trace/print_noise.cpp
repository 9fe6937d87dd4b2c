#include "sim/trace/print_noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sim {
namespace {

using Eigen::Vector2f;

/// A step of width `edge` about 0, from 0 to 1.
float Smooth(float edge, float t) { return std::clamp(t / edge + 0.5F, 0.0F, 1.0F); }

/// The values at the corners of one cell of value noise.
struct ValueCell {
  std::uint64_t seed = 0;
  bool drawn = false;
  int x = 0, y = 0;
  std::array<float, 4> corners;  ///< low left and right, high left and right

  bool Is(int x_in, int y_in, std::uint64_t seed_in) const {
    return drawn && x == x_in && y == y_in && seed == seed_in;
  }
  void Draw(int x_in, int y_in, std::uint64_t seed_in) {
    x = x_in, y = y_in, seed = seed_in, drawn = true;
    const auto at = [&](int i, int j) { return CellDraw(x + i, y + j, seed)[0]; };
    corners = {at(0, 0), at(1, 0), at(0, 1), at(1, 1)};
  }
};

/// A cell of the last ones that this thread looked at: neighbouring texels share it.
template <typename Cell>
Cell& LastCell(std::uint64_t seed) {
  thread_local std::array<Cell, 16> last;  // memory only
  return last[MixBits(seed) % last.size()];
}

/// The ellipses of random flecks that may reach into one cell of their grid: those of its own
/// and of eight neighbours, by columns, two of which the next cell shares.
struct FleckCell {
  struct Fleck {
    float row;   ///< row of its own cell, from this one
    float x, y;  ///< its middle there, cells
    float radius;
  };
  struct Column {
    int count = 0;
    std::array<Fleck, 3> flecks;
  };

  std::uint64_t seed = 0;
  float density = -1;
  int x = 0, y = 0;
  std::array<Column, 3> columns;

  void MoveTo(int x_in, int y_in, float density_in, std::uint64_t seed_in) {
    const bool same_row = y == y_in && seed == seed_in && density == density_in;
    if (same_row && x == x_in) return;
    const bool next = same_row && x + 1 == x_in;
    x = x_in, y = y_in, density = density_in, seed = seed_in;
    if (next) {
      columns[0] = columns[1];
      columns[1] = columns[2];
    } else {
      Draw(-1);
      Draw(0);
    }
    Draw(1);
  }

 private:
  void Draw(int i) {
    Column& column = columns[static_cast<std::size_t>(i + 1)];
    column.count = 0;
    for (int j = -1; j <= 1; ++j) {
      const CellDraw draw(x + i, y + j, seed);
      // Written in any case: no branch on what is as good as tossed.
      column.flecks[static_cast<std::size_t>(column.count)] = {static_cast<float>(j), draw[1],
                                                               draw[2], 0.16F + 0.3F * draw[3]};
      column.count += draw[0] < density ? 1 : 0;
    }
  }
};

}  // namespace

float ValueNoise(const Vector2f& p, std::uint64_t seed) {
  const int x = FloorOf(p.x()), y = FloorOf(p.y());
  Vector2f t(p.x() - static_cast<float>(x), p.y() - static_cast<float>(y));
  t = t.array() * t.array() * (3.0F - 2.0F * t.array());
  ValueCell& cell = LastCell<ValueCell>(seed);
  if (!cell.Is(x, y, seed)) cell.Draw(x, y, seed);
  const auto& [low_left, low_right, high_left, high_right] = cell.corners;
  const float low = low_left + (low_right - low_left) * t.x();
  const float high = high_left + (high_right - high_left) * t.x();
  return low + (high - low) * t.y();
}

float Flecks(const Vector2f& p_m, float pitch_m, float density, float stretch,
             std::uint64_t seed) {
  const Vector2f q(p_m.x() / (pitch_m * stretch), p_m.y() / pitch_m);
  const int x = FloorOf(q.x()), y = FloorOf(q.y());
  const float fx = q.x() - static_cast<float>(x), fy = q.y() - static_cast<float>(y);
  FleckCell& cell = LastCell<FleckCell>(seed);
  cell.MoveTo(x, y, density, seed);
  float inside = -1;  // the rim of an ellipse, at most
  float left = -1;
  for (const FleckCell::Column& column : cell.columns) {
    for (int k = 0; k < column.count; ++k) {
      const FleckCell::Fleck& fleck = column.flecks[static_cast<std::size_t>(k)];
      const float dx = fx - left - fleck.x, dy = fy - fleck.row - fleck.y;
      inside = std::max(inside, fleck.radius - std::sqrt(dx * dx + dy * dy));
    }
    left += 1;
  }
  return Smooth(0.12F, inside);
}

bool Glyph(const Vector2f& q, std::uint64_t bits) {
  if (q.x() < 0.1F || q.x() > 0.85F || q.y() < 0.12F || q.y() > 0.88F) return false;
  const int column = std::min(2, static_cast<int>((q.x() - 0.1F) * 4.0F));
  const int row = std::min(4, static_cast<int>((q.y() - 0.12F) * 6.6F));
  return (bits >> (5 * column + row) & 1) != 0;
}

/// Ink of running text: lines of words of letters, with ragged ends and paragraphs.
float TextInk(const Vector2f& p_m, float line_m, float width_m, std::uint64_t seed) {
  const int line = FloorOf(p_m.y() / line_m);
  const CellDraw draw(line, 7, seed);
  const float end = width_m * (draw[0] < 0.2F ? 0.35F + 0.4F * draw[1] : 0.97F);
  if (draw[2] < 0.1F || p_m.x() > end || p_m.x() < 0.03F * width_m) return 0;
  const float letter_m = 0.55F * line_m;
  const int letter = FloorOf(p_m.x() / letter_m);
  const CellDraw glyph(letter, line, seed + 1);
  if (glyph[0] < 0.19F) return 0;  // between words
  const Vector2f q(p_m.x() / letter_m - static_cast<float>(letter),
                   (p_m.y() / line_m - static_cast<float>(line)) * 1.45F);
  return Glyph(q, glyph.bits >> 16) ? 1.0F : 0.0F;
}

}  // namespace sim
