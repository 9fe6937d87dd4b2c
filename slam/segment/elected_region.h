#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/largest_part.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// Two heights over a plane that the pixels of a segment may have, and how many pixels decide.
struct HeightElection {
  std::uint8_t host = 0;  ///< label of the segment
  LabelPlane plane;
  double low = 0.0, high = 0.0;  ///< sigmas; the region's is `high`
  double window_px = 1.0;        ///< that vote on a pixel
};

/// The largest connected region, without holes, of the pixels of a segment around which most
/// lie at one of two heights: their mean is nearer to it. The memory of one search serves the
/// next.
class ElectedRegion {
 public:
  /// @param votes     pixels that have a vote; inside the image
  /// @param eligible  pixels that may be elected
  /// Cost: linear in the pixels of `votes`.
  void Elect(const DepthGrid& grid, const cv::Mat1b& labels, const HeightElection& election,
             const cv::Rect& votes, const cv::Rect& eligible);

  /// How far around a pixel those lie that vote on it.
  static int Reach(double window_px);

  /// Places in the grid, row by row.
  const std::vector<int>& pixels() const { return pixels_; }
  /// That they lie in.
  const cv::Rect& bounds() const { return bounds_; }
  PlaneSums Sum(const DepthGrid& grid) const;
  /// Mean height over the plane of the last election, sigmas.
  double MeanHeight(const DepthGrid& grid, const LabelPlane& plane) const;

 private:
  void FillHoles(int width, int height);

  cv::Rect bounds_;
  std::vector<int> pixels_;
  std::vector<std::uint8_t> mask_;
  std::vector<int> stack_;
  std::vector<double> integral_sum_;
  std::vector<int> integral_count_;
  LargestPart parts_;
};

}  // namespace slam
