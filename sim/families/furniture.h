#pragma once

#include "sim/base/random.h"
#include "sim/families/recipe.h"

/// Furniture with its front at -y; class "cabinet". Sizes are width, depth and height, metres.
namespace sim {

/// Carcass, two doors a few millimetres apart, two handles that stand out by 12 mm.
Item MakeCabinet(const Eigen::Vector3d& size, Random& random);

/// Sides, back and boards, open in front and above the last board.
Item MakeShelf(const Eigen::Vector3d& size, int boards, Random& random);

/// Height of the top of a board, the lowest is 0.
double ShelfBoard_m(const Eigen::Vector3d& size, int boards, int index);

/// Upright books on the boards of a shelf of that size, each an object of its own.
Item MakeShelfBooks(const Eigen::Vector3d& size, int boards, Random& random);

}  // namespace sim
