#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/trace/prints/print_noise.h"

namespace sim {

/// A block of a face that is split into several, each with a print of its own; and which places of
/// a grid lie in it.
struct PrintBlock {
  Eigen::Vector2f size_m;
  CellDraw draw;                    ///< of the block
  std::vector<float> x_m, y_m;      ///< of its columns and rows, from the block's lower corner
  std::size_t column = 0, row = 0;  ///< the first ones in the grid

  PrintGrid Grid() const { return {x_m, y_m}; }
  /// Calls work(place in the block, place in the whole grid).
  template <typename Work>
  void ForEachPlace(const PrintGrid& whole, const Work& work) const {
    std::size_t own = 0;
    for (std::size_t v = 0; v < y_m.size(); ++v) {
      const std::size_t first = (row + v) * whole.x_m.size() + column;
      for (std::size_t u = 0; u < x_m.size(); ++u) work(own++, first + u);
    }
  }
};

/// The blocks that hold places of the grid: the face is split up to five times, each time along the
/// longer side of the part.
std::vector<PrintBlock> BlocksOf(const PrintGrid& grid, const Eigen::Vector2f& extent_m,
                                 float smallest_m, std::uint64_t seed);

/// The same of the face without a rim on all sides; places in the rim are in none of them.
std::vector<PrintBlock> BlocksInside(const PrintGrid& grid, const Eigen::Vector2f& extent_m,
                                     float rim_m, float smallest_m, std::uint64_t seed);

}  // namespace sim
