#include "sim/trace/prints/print_noise.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/trace/lanes.h"

namespace sim {
namespace {

using Eigen::Vector2f;

constexpr float kFleckEdge_cells = 0.12F;  ///< width of a fleck's soft rim
/// Further than this outside of a fleck's rim there is none of it: more than half of the soft rim.
constexpr float kFleckReach_cells = 0.07F;

/// Where places along one axis, which grow, lie in a grid of cells.
struct CellPlaces {
  std::vector<int> cell;
  std::vector<float> inside;  ///< from the cell's lower side, cells
  /// The first place not before each cell, from that of the first place on; then their number.
  std::vector<std::size_t> start;

  template <typename Scaled>
  CellPlaces(std::span<const float> places_m, const Scaled& scaled) {
    for (const float place_m : places_m) {
      const float at = scaled(place_m);
      cell.push_back(FloorOf(at));
      inside.push_back(at - static_cast<float>(cell.back()));
      const auto cells = static_cast<std::size_t>(cell.back() - cell.front() + 1);
      if (start.size() < cells) start.resize(cells, cell.size() - 1);
    }
    start.push_back(cell.size());
  }
  /// From `at` in a cell to place i, cells.
  float Distance(int from_cell, float at, std::size_t i) const {
    return inside[i] - static_cast<float>(from_cell - cell[i]) - at;
  }
  /// The places nearer than `reach`, at most a cell, to there: from the first to before the second.
  std::pair<std::size_t, std::size_t> Near(int from_cell, float at, float reach) const {
    const auto start_of = [&](int wanted) {
      const int cells = static_cast<int>(start.size()) - 1;
      return start[static_cast<std::size_t>(std::clamp(wanted - cell.front(), 0, cells))];
    };
    std::size_t first = start_of(from_cell - 1), last = start_of(from_cell + 2);
    while (first < last && Distance(from_cell, at, first) <= -reach) ++first;
    while (first < last && Distance(from_cell, at, last - 1) >= reach) --last;
    return {first, last};
  }
};

/// One fleck; x and y from the lower corner of its cell, cells.
struct Fleck {
  int cell_x, cell_y;
  float x, y, radius;
};

/// Raises inside[i] to how far a place is inside of a fleck.
SIM_LANES void RaiseToFleck(const float* __restrict dx, float dy, float radius,
                            std::size_t count, float* __restrict inside) {
  for (std::size_t i = 0; i < count; ++i) {
    const float depth = radius - std::sqrt(dx[i] * dx[i] + dy * dy);
    inside[i] = depth > inside[i] ? depth : inside[i];
  }
}

/// A step of width `edge` about 0, from 0 to 1, of each value.
SIM_LANES void SmoothSteps(float edge, std::vector<float>& values) {
  float* __restrict value = values.data();
  const std::size_t count = values.size();
  for (std::size_t i = 0; i < count; ++i) {
    const float step = value[i] / edge + 0.5F, above = step > 0.0F ? step : 0.0F;
    value[i] = above < 1.0F ? above : 1.0F;
  }
}

/// Puts flecks one by one on the places that they reach; none is longer than to its cell's
/// neighbours.
class FleckStamp {
 public:
  FleckStamp(const CellPlaces& x, const CellPlaces& y, std::vector<float>& inside)
      : x_(x), y_(y), inside_(inside) {}

  void Put(const Fleck& fleck) {
    const float reach = fleck.radius + kFleckReach_cells;
    const auto [first_row, last_row] = y_.Near(fleck.cell_y, fleck.y, reach);
    if (first_row == last_row) return;
    const auto [first, last] = x_.Near(fleck.cell_x, fleck.x, reach);
    dx_.resize(last - first);
    for (std::size_t u = first; u < last; ++u) {
      dx_[u - first] = x_.Distance(fleck.cell_x, fleck.x, u);
    }
    for (std::size_t v = first_row; v < last_row; ++v) {
      RaiseToFleck(dx_.data(), y_.Distance(fleck.cell_y, fleck.y, v), fleck.radius, dx_.size(),
                   inside_.data() + v * x_.cell.size() + first);
    }
  }

 private:
  const CellPlaces& x_;
  const CellPlaces& y_;
  std::vector<float>& inside_;
  std::vector<float> dx_;
};

/// The values of value noise at the corners of a row of cells, from `first` to `last`.
std::vector<float> CornersOfRow(int first, int last, int y, std::uint64_t seed) {
  std::vector<float> values;
  for (int x = first; x <= last; ++x) values.push_back(CellDraw(x, y, seed)[0]);
  return values;
}

/// From 0 to 1 with level ends.
float SmoothShare(float t) { return t * t * (3.0F - 2.0F * t); }

}  // namespace

std::vector<float> ValueNoise(const PrintGrid& grid, const Vector2f& cells_per_m,
                              std::uint64_t seed) {
  const CellPlaces x(grid.x_m, [&](float x_m) { return x_m * cells_per_m.x(); });
  const CellPlaces y(grid.y_m, [&](float y_m) { return y_m * cells_per_m.y(); });
  std::vector<float> noise;
  if (grid.size() == 0) return noise;
  noise.reserve(grid.size());
  const int first = x.cell.front(), last = x.cell.back() + 1;
  std::vector<float> lower, upper;
  for (std::size_t v = 0; v < y.cell.size(); ++v) {
    if (v == 0 || y.cell[v] != y.cell[v - 1]) {
      lower = CornersOfRow(first, last, y.cell[v], seed);
      upper = CornersOfRow(first, last, y.cell[v] + 1, seed);
    }
    const float up = SmoothShare(y.inside[v]);
    for (std::size_t u = 0; u < x.cell.size(); ++u) {
      const float along = SmoothShare(x.inside[u]);
      const float* left = lower.data() + (x.cell[u] - first);
      const float* high_left = upper.data() + (x.cell[u] - first);
      const float low = left[0] + (left[1] - left[0]) * along;
      const float high = high_left[0] + (high_left[1] - high_left[0]) * along;
      noise.push_back(low + (high - low) * up);
    }
  }
  return noise;
}

std::vector<float> Flecks(const PrintGrid& grid, const FleckPattern& pattern,
                          std::uint64_t seed) {
  std::vector<float> inside(grid.size(), -1.0F);  // no place is further outside
  if (inside.empty()) return inside;
  const CellPlaces x(grid.x_m,
                     [&](float x_m) { return x_m / (pattern.pitch_m * pattern.stretch); });
  const CellPlaces y(grid.y_m, [&](float y_m) { return y_m / pattern.pitch_m; });
  FleckStamp stamp(x, y, inside);
  for (int j = y.cell.front() - 1; j <= y.cell.back() + 1; ++j) {
    for (int i = x.cell.front() - 1; i <= x.cell.back() + 1; ++i) {
      const CellDraw draw(i, j, seed);
      if (draw[0] < pattern.density) {
        stamp.Put({i, j, draw[1], draw[2], 0.16F + 0.3F * draw[3]});
      }
    }
  }
  SmoothSteps(kFleckEdge_cells, inside);
  return inside;
}

bool Glyph(const Vector2f& q, std::uint64_t bits) {
  if (q.x() < 0.1F || q.x() > 0.85F || q.y() < 0.12F || q.y() > 0.88F) return false;
  const int column = std::min(2, static_cast<int>((q.x() - 0.1F) * 4.0F));
  const int row = std::min(4, static_cast<int>((q.y() - 0.12F) * 6.6F));
  return (bits >> (5 * column + row) & 1) != 0;
}

std::vector<float> TextInk(const PrintGrid& grid, float line_m, float width_m,
                           std::uint64_t seed) {
  std::vector<float> ink(grid.size(), 0.0F);
  const float letter_m = 0.55F * line_m;
  const CellPlaces x(grid.x_m, [&](float x_m) { return x_m / letter_m; });
  const CellPlaces y(grid.y_m, [&](float y_m) { return y_m / line_m; });
  for (std::size_t v = 0; v < grid.y_m.size(); ++v) {
    const int line = y.cell[v];
    const CellDraw draw(line, 7, seed);
    if (draw[2] < 0.1F) continue;  // between paragraphs
    const float end = width_m * (draw[0] < 0.2F ? 0.35F + 0.4F * draw[1] : 0.97F);
    CellDraw glyph(0, line, seed + 1);
    for (std::size_t u = 0; u < grid.x_m.size(); ++u) {
      if (u == 0 || x.cell[u] != x.cell[u - 1]) glyph = CellDraw(x.cell[u], line, seed + 1);
      if (grid.x_m[u] > end || grid.x_m[u] < 0.03F * width_m) continue;
      if (glyph[0] < 0.19F) continue;  // between words
      if (Glyph({x.inside[u], y.inside[v] * 1.45F}, glyph.bits >> 16)) {
        ink[v * grid.x_m.size() + u] = 1.0F;
      }
    }
  }
  return ink;
}

}  // namespace sim
