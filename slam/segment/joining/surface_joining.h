#pragma once

#include <cstdint>
#include <vector>

#include "slam/segment/joining/join_config.h"
#include "slam/segment/joining/parts_on_blocks.h"
#include "slam/segment/pixels/label_pairs.h"

namespace slam {

/// Which labels are one surface.
struct JoinedLabels {
  std::vector<int> into;           ///< label that each label has become part of, or itself
  std::vector<PlaneSums> sums;     ///< of what has become one; empty for what is part of it
  std::vector<std::uint8_t> bent;  ///< 1: made of parts that the sensor may bend apart
};

/// Joins labels that continue each other where they meet. A step is sharp, its whole height
/// there within a few pixels on either side of the border, where a bend of the sensor has
/// hardly begun. So the labels' pixels within some blocks of the border are fitted by two
/// planes; if these have one value and one slope in the mean square, up to noise and to what a
/// bend does over so few pixels, and the union as one plane keeps within the bend, there is one
/// surface. Of what has been joined the whole border counts, so a step along a part of it holds.
///
/// @param contacts  sides of pixels that labels share; null: all of neighbouring blocks touch
/// @param bent      labels that are bent already; empty: none
JoinedLabels JoinSurfaces(const PartsOnBlocks& on, std::size_t label_count,
                          LabelPairs<int>* contacts, std::vector<std::uint8_t> bent,
                          const DepthNoise& noise, const JoinConfig& config);

}  // namespace slam
