#pragma once

#include <cstdint>
#include <vector>

namespace slam {

/// Connected parts of a mask; the memory of one mask serves the next.
class LargestPart {
 public:
  /// The places of the largest 4-connected part of the non-zero entries, the first of equal
  /// ones. @param mask  row by row, `width` entries each
  const std::vector<int>& Of(const std::vector<std::uint8_t>& mask, int width);

 private:
  std::vector<std::uint8_t> seen_;
  std::vector<int> stack_, part_, largest_;
};

}  // namespace slam
