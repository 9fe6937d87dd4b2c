#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/depth_grid.h"
#include "slam/segment/label_pairs.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// How much of the difference between the planes of two labels is there right at their common
/// boundary, where strips on either side are fitted by themselves: all of it at a crease or a
/// step, a part where one surface bends from one plane into the other.
struct BoundaryShare {
  double share = 0.0;  ///< 1: all of it; the least-squares factor between the differences
  double sigma = 0.0;  ///< its standard deviation from noise

  /// Whether noise leaves no doubt that two surfaces meet here. A bend of constant curvature
  /// has a third, as strips reach into a label by a third of its width: what is nearer to all
  /// than to that is none.
  bool IsCrease() const { return share - 2.0 * sigma > kMinCreaseShare; }
  static constexpr double kMinCreaseShare = 0.67;  ///< half way from a third to all
};

/// Shares of labels that touch. Labels too narrow to look into are not in it.
using BoundaryShares = LabelPairs<BoundaryShare>;

/// Strips on either side of a boundary.
struct BoundaryStrips {
  PlaneSums low, high;  ///< on the side of the lower and the higher label
};

/// @param labels  one a pixel
/// @param runs    runs of these labels
/// @param planes  fitted to the labels' pixels
/// @param strips  scratch
/// @param shares  what is found; what was in it is forgotten
void MeasureShares(const DepthGrid& grid, const LabelImage& labels, const LabelRuns& runs,
                   const std::vector<LabelPlane>& planes, const DepthNoise& noise,
                   LabelPairs<BoundaryStrips>& strips, BoundaryShares& shares);

}  // namespace slam
