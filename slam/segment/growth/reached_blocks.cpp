#include "slam/segment/growth/reached_blocks.h"

#include <algorithm>

#include "slam/base/index.h"

namespace slam {

void ReachedBlocks::Begin(int cols, int rows) {
  Clear();
  cols_ = cols, row_count_ = rows;
  // The margin is a column and a row wide, and more on the right, where bytes end. Three bits
  // are read from two bytes, so one byte more follows.
  row_bytes_ = static_cast<std::size_t>(cols + 2 + 7) / 8;
  label_bytes_ = row_bytes_ * static_cast<std::size_t>(rows + 2) + 1;
  none_.assign(label_bytes_, 0xff);
  for (int r = 0; r < rows; ++r) {
    for (unsigned c = 1; c <= static_cast<unsigned>(cols); ++c)
      none_[Row(r, 0) + c / 8] &= static_cast<std::uint8_t>(~(1u << c % 8));
  }
}

void ReachedBlocks::AddLabel() {
  bits_.insert(bits_.end(), none_.begin(), none_.end());
  rows_of_.push_back({row_count_, -1});
}

void ReachedBlocks::Forget(int label) {
  std::copy(none_.begin(), none_.end(),
            bits_.begin() + static_cast<std::ptrdiff_t>(Row(-1, label)));
  rows_of_[Index(label)] = {row_count_, -1};
}

}  // namespace slam
