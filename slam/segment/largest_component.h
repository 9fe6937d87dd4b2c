#pragma once

#include <opencv2/core/mat.hpp>

namespace slam {

/// The largest 4-connected component of the non-zero entries, the first of equal ones: 255
/// where it is, 0 elsewhere. All 0 for an empty mask.
cv::Mat1b LargestComponent(const cv::Mat1b& mask);

}  // namespace slam
