#pragma once

#include <cstddef>
#include <opencv2/core/types.hpp>
#include <vector>

#include "slam/segment/pixels/block_pixels.h"
#include "slam/segment/pixels/depth_grid.h"
#include "slam/segment/pixels/label_runs.h"
#include "slam/segment/pixels/pixel_labels.h"

namespace slam {

/// What is seen in the image between two parts of one plane. Where it is behind the plane, the
/// plane ends; where it is in front, on the plane or not measured, the plane may go on.
class SightLines {
 public:
  /// Samples the parts on a grid of pixels.
  /// @param part  one a run, -1 = none. All but this must outlive what is asked.
  SightLines(const DepthGrid& grid, const LabelRuns& runs, std::vector<int> part,
             int part_count);

  /// Whether of the straight lines from all over `a` to all over `b` so many pass something
  /// clearly behind `plane` that it ends between them. True of a part that the grid has missed.
  /// @param unsure_sigmas  what is as near to the plane is not clearly off it
  bool PassBehind(int a, int b, const LabelPlane& plane, double unsure_sigmas = 0.0) const;

 private:
  int PartAt(std::size_t i) const;
  bool PassesBehind(const cv::Point& from, const cv::Point& to, int a, int b,
                    const PixelPlane& plane, float clear) const;

  const DepthGrid& grid_;
  const LabelRuns& runs_;
  std::vector<int> part_;
  std::vector<std::vector<cv::Point>> samples_;  ///< of each part, row by row
};

}  // namespace slam
