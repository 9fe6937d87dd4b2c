#pragma once

#include <cstddef>
#include <vector>

namespace slam {

/// Makes room for `size` entries; what is there stays. Grows by more than is asked, so that it
/// soon no longer does.
template <typename T>
void Provide(std::vector<T>& room, std::size_t size) {
  if (room.size() < size) room.resize(size + size / 2);
}

}  // namespace slam
