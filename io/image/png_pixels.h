#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

namespace io {

/// The pixels of a PNG file as recordings have them, 8-bit RGB (CV_8UC3, blue first) or gray of 8 or 16
/// bits (CV_8UC1, CV_16UC1), inflated by libdeflate, which takes less than half of zlib's time. Empty
/// for a file of any other kind, and for one that is not whole: libpng may know it.
cv::Mat PngPixels(std::string_view file);

}  // namespace io
