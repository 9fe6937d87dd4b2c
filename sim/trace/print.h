#pragma once

#include <Eigen/Core>

#include "sim/scene/scene.h"

namespace sim {

/// Where on a face, and how big the face is.
struct PrintSpot {
  Eigen::Vector2f p_m;       ///< from the face's lower corner, metres
  Eigen::Vector2f extent_m;  ///< the face, metres
};

/// Linear reflectance in [0, 1] of a printed face at a spot. Procedural, no state: the pattern
/// hangs on material.seed alone. `richness` scales contrast and density; 0 leaves the base
/// colour. Every print but kPlain has marks of 2 mm to 60 mm that do not repeat, so that
/// corners are found, and told apart, from 0.5 m to 2 m.
Eigen::Array3f Reflectance(const Material& material, const PrintSpot& spot);

}  // namespace sim
