#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "slam/base/index.h"
#include "slam/geometry/plane_sums.h"

namespace slam {

/// What a label has of a block.
struct BlockPart {
  int label = 0;
  PlaneSums sums;
};

/// The blocks of an image, with the parts that labels have of them.
struct PartsOnBlocks {
  int cols = 0, rows = 0;
  std::vector<BlockPart> parts;    ///< block by block
  std::vector<std::size_t> first;  ///< part of each block, row by row, and one more

  void Begin(int block_cols, int block_rows) {
    cols = block_cols, rows = block_rows;
    parts.clear(), first.clear();
  }
  /// Calls visit(part) for the parts of the blocks in columns [c0, c1] and rows [r0, r1].
  template <typename Visit>
  void VisitWindow(int c0, int r0, int c1, int r1, const Visit& visit) const {
    c0 = std::max(c0, 0), r0 = std::max(r0, 0);
    c1 = std::min(c1, cols - 1), r1 = std::min(r1, rows - 1);
    for (int r = r0; r <= r1; ++r) {
      const auto row = static_cast<std::size_t>(r * cols);
      const std::size_t end = first[row + static_cast<std::size_t>(c1) + 1];
      for (std::size_t k = first[row + static_cast<std::size_t>(c0)]; k < end; ++k)
        visit(parts[k]);
    }
  }
};

/// Sums of all parts of each label.
inline std::vector<PlaneSums> SumParts(const PartsOnBlocks& on, std::size_t label_count) {
  std::vector<PlaneSums> sums(label_count);
  for (const BlockPart& part : on.parts) sums[Index(part.label)] += part.sums;
  return sums;
}

}  // namespace slam
