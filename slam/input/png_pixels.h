#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>

namespace slam {

/// The pixels of a PNG file as recordings have them, 8-bit RGB (CV_8UC3, blue first) or 16-bit gray
/// (CV_16UC1), inflated by libdeflate, which takes less than half of zlib's time. Empty for a file of
/// any other kind, and for one that is not whole: another decoder may know it, or say what is wrong.
cv::Mat PngPixels(std::span<const std::uint8_t> file);

}  // namespace slam
