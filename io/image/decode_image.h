#pragma once

#include <opencv2/core/mat.hpp>
#include <string_view>

namespace io {

/// The pixels of a PNG file as they are stored (8 or 16 bits a colour, blue first; palettes and grays of
/// less than 8 bits unfolded), or of a JPEG file as 8-bit colour (CV_8UC3, blue first), whatever it says
/// of the camera's orientation. Empty for bytes that are neither or cannot be decoded. Ask
/// ReadImageHeader first: what is cut off may be filled up, and a header may ask for gigabytes.
cv::Mat DecodeImage(std::string_view file);

}  // namespace io
