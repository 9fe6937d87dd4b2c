#pragma once

#include <opencv2/core/mat.hpp>

namespace io {

/// A decoded image of 8 bits as colour, blue first: gray becomes colour, and alpha is left out, whatever
/// it says. Others, and empty ones, stay as they are.
cv::Mat AsBgr(const cv::Mat& image);

}  // namespace io
