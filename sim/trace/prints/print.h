#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene/scene.h"
#include "sim/trace/prints/print_noise.h"

namespace sim {

/// Linear reflectance in [0, 1] of a printed face at the places of a grid, row by row. Procedural, no
/// state: the pattern hangs on material.seed alone. `richness` scales contrast and density; 0
/// leaves the base colour. Every print but kPlain has marks of 2 mm to 60 mm that do not repeat,
/// so that corners are found, and told apart, from 0.5 m to 2 m.
/// @param extent_m  the whole face; places are from its lower corner
std::vector<Eigen::Array3f> Reflectance(const Material& material,
                                        const Eigen::Vector2f& extent_m, const PrintGrid& grid);

}  // namespace sim
