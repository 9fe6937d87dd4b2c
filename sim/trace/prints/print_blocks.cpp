#include "sim/trace/prints/print_blocks.h"

#include <algorithm>

namespace sim {
namespace {

constexpr int kMaxCuts = 5;

/// A part of the face while it is split.
struct Part {
  Eigen::Vector2f size_m;
  std::uint64_t name = 0;
  std::vector<float> x_m, y_m;
  std::size_t column = 0, row = 0;
};

/// What lies on one side of a cut across an axis.
Part SideOf(const Part& part, int axis, float cut_m, bool upper) {
  Part side = part;
  std::vector<float>& places = axis == 0 ? side.x_m : side.y_m;
  const auto at = std::lower_bound(places.begin(), places.end(), cut_m);
  if (upper) {
    (axis == 0 ? side.column : side.row) += static_cast<std::size_t>(at - places.begin());
    places.erase(places.begin(), at);
    for (float& place : places) place -= cut_m;
    side.size_m[axis] -= cut_m;
  } else {
    places.erase(at, places.end());
    side.size_m[axis] = cut_m;
  }
  return side;
}

/// Splits until a part is small, or a toss ends it.
void Split(const Part& part, float smallest_m, int cuts, std::vector<PrintBlock>& blocks) {
  if (part.x_m.empty() || part.y_m.empty()) return;
  const CellDraw draw(cuts, 0, part.name);
  const int axis = part.size_m.x() > part.size_m.y() ? 0 : 1;
  const float length_m = part.size_m[axis];
  if (cuts == kMaxCuts || length_m < 2.2F * smallest_m || (cuts > 2 && draw[1] < 0.35F)) {
    blocks.push_back(
        {part.size_m, CellDraw(1, 2, part.name), part.x_m, part.y_m, part.column, part.row});
    return;
  }
  const float cut_m = length_m * (0.3F + 0.4F * draw[0]);
  for (const bool upper : {false, true}) {
    Part side = SideOf(part, axis, cut_m, upper);
    side.name =
        MixBits(part.name + (upper ? 0x51ull : 0xA3ull) + static_cast<std::uint64_t>(cuts));
    Split(side, smallest_m, cuts + 1, blocks);
  }
}

}  // namespace

std::vector<PrintBlock> BlocksOf(const PrintGrid& grid, const Eigen::Vector2f& extent_m,
                                 float smallest_m, std::uint64_t seed) {
  std::vector<PrintBlock> blocks;
  Split(
      {extent_m, seed, {grid.x_m.begin(), grid.x_m.end()}, {grid.y_m.begin(), grid.y_m.end()}},
      smallest_m, 0, blocks);
  return blocks;
}

std::vector<PrintBlock> BlocksInside(const PrintGrid& grid, const Eigen::Vector2f& extent_m,
                                     float rim_m, float smallest_m, std::uint64_t seed) {
  Part inner{extent_m - Eigen::Vector2f(2 * rim_m, 2 * rim_m), seed, {}, {}};
  const auto keep = [&](std::span<const float> places, float length_m, std::vector<float>& kept,
                        std::size_t& first) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (places[i] < rim_m || length_m - places[i] < rim_m) continue;
      if (kept.empty()) first = i;
      kept.push_back(places[i] - rim_m);
    }
  };
  keep(grid.x_m, extent_m.x(), inner.x_m, inner.column);
  keep(grid.y_m, extent_m.y(), inner.y_m, inner.row);
  std::vector<PrintBlock> blocks;
  Split(inner, smallest_m, 0, blocks);
  return blocks;
}

}  // namespace sim
