#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// Pixels of one segment.
struct PixelRegion {
  cv::Rect bounds;          ///< the pixels lie inside
  std::vector<int> pixels;  ///< places in the grid (DepthGrid::Index), row by row
};

/// Where a segment is looked at for a part of it that lies higher than the rest.
struct RaisedRegionSearch {
  std::uint8_t label = 0;      ///< the segment's in the label image
  LabelPlane plane;            ///< heights are over it
  double middle_sigmas = 0.0;  ///< the height half way between the part's and the rest's
  double window_px = 1.0;      ///< so many pixels around a pixel vote on it
  cv::Rect voters;             ///< only what lies in it has a vote; inside the image
  cv::Rect eligible;           ///< only what lies in it may belong to the part
};

/// How far around a pixel those lie that vote on it, pixels.
int VoteReach(double window_px);

/// The largest 4-connected region, its holes filled, of the segment's pixels around which the
/// mean height over the plane exceeds the middle. Empty where there is none.
/// Cost: linear in the pixels of `voters`.
PixelRegion FindRaisedRegion(const DepthGrid& grid, const cv::Mat1b& labels,
                             const RaisedRegionSearch& search);

PlaneSums SumOf(const DepthGrid& grid, const PixelRegion& region);
/// Mean height over a plane, sigmas; 0 for an empty region.
double MeanHeight(const DepthGrid& grid, const PixelRegion& region, const LabelPlane& plane);

}  // namespace slam
