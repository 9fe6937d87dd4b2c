#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

namespace sim {

/// A point as a key: whole nanometres.
using Place = std::array<std::int64_t, 3>;

inline Place Nanometres(const Eigen::Vector3d& x) {
  return {std::llround(x.x() * 1e9), std::llround(x.y() * 1e9), std::llround(x.z() * 1e9)};
}

}  // namespace sim
