#pragma once

#include <cstdint>
#include <vector>

#include "slam/segment/growth/growth_config.h"
#include "slam/segment/growth/planes_on_blocks.h"

namespace slam {

/// The planes that gain less than min_gain a pixel: 1 or 0 for each label.
///
/// What a plane gains at its pixels is measured against the next best plane there: the difference
/// of the squared distances, sigmas^2. Where no other plane is near, the next best is as far away
/// as WideSigmas. Planes are asked with the fewest pixels first, and a useless one no longer
/// counts as the next best of those after it.
std::vector<std::uint8_t> FindUseless(const PlanesOnBlocks& on, const GrowthConfig& config);

}  // namespace slam
