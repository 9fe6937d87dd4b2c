#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/model/feature_scale.h"

namespace slam {

/// One octave of an image, with a frame of mirrored pixels around it, so that patches at the
/// border need no special case.
struct PyramidImage {
  cv::Mat1b padded;  ///< the octave and `kPyramidPadding_px` pixels on every side
  cv::Mat1b image;   ///< the octave itself, a view into `padded`
  /// Full-image pixels a pixel of this octave, along u and v: sides are whole pixels, so the
  /// two differ a little from each other and from the pyramid's factor.
  double scale_u = 1.0, scale_v = 1.0;
};

/// Holds the largest patch that orientation and descriptor look at, blurred.
inline constexpr int kPyramidPadding_px = 24;

/// Octaves of an 8-bit image from the finest on; stops where one would be under 24 pixels high
/// or wide, so there may be fewer than asked for.
std::vector<PyramidImage> BuildImagePyramid(const cv::Mat1b& image, const FeatureScale& scale);

}  // namespace slam
