#pragma once

#include "sim/shapes/toy.h"

namespace sim {

/// Bodies of rounded limbs that fill the box `size` (metres, centred at the origin) exactly;
/// each limb is closed, and reaches into its neighbours. The person stands and looks along -y;
/// the hand lies palm down, its fingers along +y, its forearm behind.
ClosedSurface PersonSurface(const Eigen::Vector3d& size);
ClosedSurface HandSurface(const Eigen::Vector3d& size);

}  // namespace sim
