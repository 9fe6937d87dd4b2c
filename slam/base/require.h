#pragma once

#include <stdexcept>

namespace slam {

/// Checks a promise of the caller (unit normal, equal sizes); always armed, O(1) checks only.
/// @throws std::invalid_argument with `message` when `condition` is false.
inline void Require(bool condition, const char* message) {
  if (!condition) throw std::invalid_argument(message);
}

}  // namespace slam
