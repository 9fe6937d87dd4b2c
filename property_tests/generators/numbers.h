#pragma once

#include <rapidcheck.h>

namespace generators {

/// A whole number from `low` to `high`, both included, drawn inside a property at full size:
/// rapidcheck's own ranges shrink with the size parameter.
inline int AnyInt(int low, int high) {
  return *rc::gen::resize(100, rc::gen::inRange(low, high + 1));
}

}  // namespace generators
