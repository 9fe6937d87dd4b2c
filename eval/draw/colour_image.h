#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

namespace eval {

/// Reads a colour image, PNG or JPEG, as 8-bit BGR; its pixels lie as they are stored, whatever
/// the file says of the camera's orientation.
/// @throws InputError naming the file when it cannot be read, is no image or is too large
cv::Mat ReadColourImage(const std::filesystem::path& file);

}  // namespace eval
