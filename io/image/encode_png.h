#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

namespace io {

/// Bytes of a PNG file of an image of 8 bits (1 or 3 channels, blue first) or 16 bits (1
/// channel). Lossless. Compressed by libdeflate at its fastest level, several times as fast as
/// zlib; the same image gives the same bytes.
/// @throws std::invalid_argument for an empty image or another type
std::string EncodePng(const cv::Mat& image);

}  // namespace io
