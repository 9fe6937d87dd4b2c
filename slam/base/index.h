#pragma once

#include <cstddef>

namespace slam {

/// Position in a vector of what an id names: ids are ints, because kNone is one of them.
constexpr std::size_t Index(int id) { return static_cast<std::size_t>(id); }

}  // namespace slam
