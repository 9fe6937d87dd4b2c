#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

namespace sim {

/// A closed surface: vertices and counter-clockwise triangles seen from outside.
struct ClosedSurface {
  std::vector<Eigen::Vector3d> vertices_o;
  std::vector<std::array<int, 3>> triangles;
};

/// A smooth lump with bumps and a flat base, star-shaped about its middle, that fills the box
/// `size` (metres, centred at the origin) exactly. 320 triangles; the shape depends on `seed`.
ClosedSurface ToySurface(const Eigen::Vector3d& size, std::uint64_t seed);

/// Foliage: the same with many small bumps on every side. 1280 triangles.
ClosedSurface BushSurface(const Eigen::Vector3d& size, std::uint64_t seed);

}  // namespace sim
