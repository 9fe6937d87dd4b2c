#pragma once

#include <vector>

#include "slam/segment/joining/join_config.h"
#include "slam/segment/joining/parts_on_blocks.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

inline constexpr int kTile_blocks = 2;  ///< side of what shares a local plane
inline int TileCount(int blocks) { return (blocks + kTile_blocks - 1) / kTile_blocks; }

/// The surface of a label that the sensor bends: a plane for each tile of blocks, fitted to the
/// label's pixels within a block around it and drawn to the label's own plane by what a bend
/// may be. Where the label has nothing nearby it is the label's own plane.
/// @param into  label that each label of the parts is part of
std::vector<LabelPlane> FitLocally(const PartsOnBlocks& on, const std::vector<int>& into,
                                   int label, const LabelPlane& plane, const DepthNoise& noise,
                                   const JoinConfig& config);

}  // namespace slam
