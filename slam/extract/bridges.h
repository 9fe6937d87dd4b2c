#pragma once

#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/pixel_labels.h"

namespace slam {

/// Takes components apart that only a bridge of a pixel or two holds together, when what lies
/// between their parts is behind the plane: two tops of one height, the desk's edge pixels
/// between them mistaken for theirs. A surface that holes make thin has nothing behind it and
/// stays whole.
///
/// @param max_behind  share of the measured pixels between two parts that may lie behind
void CutBridges(const DepthGrid& grid, const LabelImage& labels,
                const std::vector<LabelPlane>& planes, double max_behind,
                LabelComponents& components);

}  // namespace slam
