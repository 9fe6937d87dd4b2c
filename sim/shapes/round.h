#pragma once

#include "sim/scene/scene.h"
#include "sim/shapes/toy.h"

namespace sim {

/// A body of revolution about z that fills the box `size` (metres, centred at the origin): one
/// of kCylinder, kMug, kBottle, kBowl. Closed; 48 corners a circle.
/// @throws std::invalid_argument for another kind.
ClosedSurface RoundSurface(ShapeKind kind, const Eigen::Vector3d& size);

}  // namespace sim
