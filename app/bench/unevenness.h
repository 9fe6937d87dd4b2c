#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

namespace app {

/// A block of 16 x 16 pixels that a surface fills to a half.
struct BlockResidual {
  bool on_plane = true;  ///< false: something else is there
  double depth_m = 0.0;  ///< mean
  /// Mean residual from the surface's best plane in inverse depth, in disparity steps of a first
  /// Kinect (1/8 pixel: z^2 / 351.3 m).
  double steps = 0.0;
};

/// How far the large surfaces of a depth image are from flat: each from its best plane in this
/// image, to which blocks with other things on them (beyond three sigmas of the surface's
/// blocks, by their median) do not count. Surfaces of less than 5 % of the image are left out.
/// @param labels  which surface each pixel shows, 0 = none; rays: (x, y) of each pixel's ray
/// @returns blocks in an order that follows from the labels and which depths are there
std::vector<BlockResidual> BlockResiduals(const cv::Mat1f& depth_m, const cv::Mat1w& labels,
                                          const cv::Mat2d& rays);

}  // namespace app
