#pragma once

#include <opencv2/core/types.hpp>
#include <optional>

#include "slam/segment/depth_grid.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/seam_search.h"

namespace slam {

/// What the pixels on either side of a line say about a step there. Each side has a plane of
/// its own, fitted without what is next to the line, which the sensor smooths.
struct SeamEvidence {
  /// Of the gap between the planes along the line, 2 degrees of freedom. A crease has none, nor
  /// has a bend of one curvature with sides of one width.
  double chi2 = 0.0;
  double gap_sigmas = 0.0;  ///< root mean square along the line, less what noise adds to it
  /// The part of the gap that is there between planes fitted to the nearer halves of both sides
  /// (least squares): all of a step, a quarter of what a bend with unequal sides makes.
  double share = 0.0;
};

/// A segment, and how to look at it.
struct SeamView {
  int label = 0;
  cv::Rect bounds;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
  int step_px = 1;       ///< only every such pixel of every such row is looked at
};

/// @returns nothing where a side has too few pixels to say
std::optional<SeamEvidence> WeighSeam(const DepthGrid& grid, const LabelImage& labels,
                                      const SeamView& view, const Seam& seam,
                                      const DepthNoise& noise);

}  // namespace slam
