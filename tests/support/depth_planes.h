// The planes of one depth image, without the extractor that a tracker keeps.
#pragma once

#include <vector>

#include "slam/geometry/plane_sums.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/image_blocks.h"
#include "slam/segment/pixels/pixel_labels.h"
#include "slam/segment/plane_segments.h"

namespace slam {

/// SetRays and SetDepth of a new grid.
inline DepthGrid MakeDepthGrid(const cv::Mat1f& depth_m, const cv::Mat2d& rays,
                               const DepthNoise& noise, double max_depth_m) {
  DepthGrid grid;
  SetRays(rays, grid);
  SetDepth(depth_m, noise, max_depth_m, grid);
  return grid;
}

/// SetBlocks of a grid, which must outlive them.
inline ImageBlocks MakeBlocks(const DepthGrid& grid) {
  ImageBlocks blocks;
  SetBlocks(grid, blocks);
  return blocks;
}

/// Sums of the pixels of each label, one pixel after the other.
inline std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels,
                                        int count) {
  std::vector<PlaneSums> sums(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const double g = static_cast<double>(grid.g[i]);
    if (labels[i] == kNoLabel || !(g > 0.0)) continue;
    sums[static_cast<std::size_t>(labels[i])].Add(static_cast<double>(grid.x[i]),
                                                  static_cast<double>(grid.y[i]),
                                                  static_cast<double>(grid.q[i]), g * g);
  }
  return sums;
}

/// PlaneExtractor::Extract of a frame that comes alone.
inline void ExtractPlanes(Frame& frame, const cv::Mat2d& rays,
                          const PlaneExtractionConfig& config, const SensorModel& sensor = {}) {
  PlaneExtractor(rays, sensor, config).Extract(frame);
}

}  // namespace slam
