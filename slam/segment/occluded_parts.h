#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/joining/surfaces.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/label_runs.h"

namespace slam {

/// Segments 0, 1, ... of an image.
struct PartSegments {
  LabelRuns runs;  ///< kNoLabel where a part is too small; neighbours may be of one
  std::vector<PlaneSums> sums;  ///< of the pixels of each segment
};

/// The segments that connected parts of labels make, across what hides parts of them.
///
/// Two parts are one plane though nothing joins them in the image if the smaller lies on the
/// larger's extension, hardly touches it (what does was asked for steps, JoinSurfaces), and
/// hardly anything behind the plane is seen between them: the plane can pass behind what is in
/// front. Two book tops of one height have the desk between them, which is behind, and stay
/// apart.
///
/// @param labels  runs of the labels of the surfaces
PartSegments SegmentParts(const DepthGrid& grid, const std::vector<Surface>& surfaces,
                          const LabelRuns& labels, const DepthNoise& noise,
                          const PlaneExtractionConfig& config);

}  // namespace slam
