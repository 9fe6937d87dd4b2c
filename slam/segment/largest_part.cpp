#include "slam/segment/largest_part.h"

#include <cstddef>

namespace slam {

const std::vector<int>& LargestPart::Of(const std::vector<std::uint8_t>& mask, int width) {
  const int count = static_cast<int>(mask.size());
  seen_.assign(mask.size(), 0);
  largest_.clear();
  const auto visit = [&](int i) {
    const auto k = static_cast<std::size_t>(i);
    if (mask[k] == 0 || seen_[k] != 0) return;
    seen_[k] = 1;
    stack_.push_back(i), part_.push_back(i);
  };
  for (int start = 0; start < count; ++start) {
    part_.clear(), stack_.clear();
    visit(start);
    while (!stack_.empty()) {
      const int i = stack_.back();
      stack_.pop_back();
      if (i % width > 0) visit(i - 1);
      if (i % width + 1 < width) visit(i + 1);
      if (i >= width) visit(i - width);
      if (i + width < count) visit(i + width);
    }
    if (part_.size() > largest_.size()) largest_.swap(part_);
  }
  return largest_;
}

}  // namespace slam
