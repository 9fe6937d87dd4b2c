#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/base/index.h"

namespace slam {

/// Which blocks of an image each label has reached: a bit for each block, row by row. Around
/// the blocks lies a margin that counts as reached, so that growth never asks where the image
/// ends.
class ReachedBlocks {
 public:
  /// Forgets everything and begins with an image of so many blocks.
  void Begin(int cols, int rows);
  /// Forgets the labels.
  void Clear() { bits_.clear(), rows_of_.clear(); }
  /// The next label, which has reached nothing.
  void AddLabel();
  /// The label has reached nothing any more.
  void Forget(int label);

  /// @param place  column and row of a block
  /// @returns whether the label had not reached it yet
  bool Add(int label, const cv::Point& place) {
    const auto c = static_cast<unsigned>(place.x + 1);
    std::uint8_t& bits = bits_[Row(place.y, label) + c / 8];
    const unsigned bit = 1u << c % 8;
    if ((bits & bit) != 0) return false;
    bits = static_cast<std::uint8_t>(bits | bit);
    Rows& rows = rows_of_[Index(label)];
    rows = {std::min(rows.first, place.y), std::max(rows.last, place.y)};
    return true;
  }

  /// The blocks around one, and itself, that a label has not reached: three bits a row, the
  /// left one lowest.
  unsigned MissingAround(int label, const cv::Point& place) const {
    const auto c =
        static_cast<unsigned>(place.x);  // column of the block to the left, after the margin
    const std::uint8_t* row = bits_.data() + Row(place.y - 1, label) + c / 8;
    unsigned reached = 0;
    for (unsigned r = 0; r < 3; ++r, row += row_bytes_) {
      const unsigned bits = row[0] | static_cast<unsigned>(row[1]) << 8;
      reached |= (bits >> c % 8 & 7u) << 3 * r;
    }
    return ~reached & 0x1ffu;
  }

  /// Calls visit(block) for the blocks that a label has reached, in their order, until it says
  /// that this is enough.
  template <typename Visit>
  void VisitBlocks(int label, const Visit& visit) const {
    const Rows rows = rows_of_[Index(label)];
    for (int r = rows.first; r <= rows.last; ++r) {
      const std::size_t row = Row(r, label), margin = Row(r, 0);
      for (std::size_t byte = 0; byte < row_bytes_; ++byte) {
        unsigned bits = bits_[row + byte] & ~none_[margin + byte] & 0xffu;
        for (; bits != 0; bits &= bits - 1) {
          const int c = 8 * static_cast<int>(byte) + std::countr_zero(bits) - 1;
          if (visit(r * cols_ + c)) return;
        }
      }
    }
  }

 private:
  /// The rows that a label has reached lie between these.
  struct Rows {
    int first, last;
  };

  /// Place of a label's row of blocks; -1 and the row after the last are margin.
  std::size_t Row(int row, int label) const {
    return static_cast<std::size_t>(label) * label_bytes_ +
           static_cast<std::size_t>(row + 1) * row_bytes_;
  }

  int cols_ = 0, row_count_ = 0;
  std::size_t row_bytes_ = 0, label_bytes_ = 0;  ///< a row's and a label's part of bits_
  std::vector<std::uint8_t> bits_;               ///< label by label
  std::vector<std::uint8_t> none_;  ///< what a label that has reached nothing has: the margin
  std::vector<Rows> rows_of_;       ///< one a label
};

}  // namespace slam
