#include "sim/trace/edge_blocks.h"

#include <algorithm>
#include <cmath>

namespace sim {
namespace {

/// What is on an edge is half a step from a mark, along either axis; the pixels round a block are
/// one further. The rest is for a lens, behind which edges are told by short straight pieces.
constexpr double kReach_px = 0.5 * EdgeBlocks::kStep_px + 1.0 + 0.5;

}  // namespace

void EdgeBlocks::Start(const Camera& camera) {
  columns_ = (camera.width + kSide - 1) / kSide;
  rows_ = (camera.height + kSide - 1) / kSide;
  passed_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0);
}

void EdgeBlocks::Mark(double u, double v) {
  // Blocks whose pixels, from 0 to 7, are within reach.
  const auto first = [](double at) {
    return std::max(static_cast<int>(std::ceil((at - kReach_px - (kSide - 1)) / kSide)), 0);
  };
  const auto last = [](double at, int count) {
    return std::min(static_cast<int>(std::floor((at + kReach_px) / kSide)), count - 1);
  };
  for (int row = first(v); row <= last(v, rows_); ++row) {
    for (int column = first(u); column <= last(u, columns_); ++column) {
      passed_[At(column, row)] = 1;
    }
  }
}

}  // namespace sim
