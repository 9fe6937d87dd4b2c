#pragma once

#include <cstddef>

namespace slam {

/// No keyframe, no map point, no map plane, no feature: ids and indices count from 0.
inline constexpr int kNone = -1;

/// Position in a vector of what an id names: ids are ints, because kNone is one of them.
constexpr std::size_t Index(int id) { return static_cast<std::size_t>(id); }

}  // namespace slam
