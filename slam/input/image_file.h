#pragma once

#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <string>

#include "slam/geometry/camera.h"

namespace slam {

/// What a recorded image must be. It is checked in the file's header, before any decoding.
enum class ImageType {
  kColour,  ///< PNG or JPEG, 8-bit RGB or gray, with alpha or without
  kDepth    ///< PNG, 16-bit, one channel
};

/// Reads an image of the camera's size: CV_8UC3 in BGR order, gray in all three, or CV_16UC1. Whether it is a PNG or a
/// JPEG is seen from its content, whatever it is called.
/// @param context  what the file is, for messages: "frame 12"
/// @throws InputError naming file and context when the file is missing, empty, truncated,
///   damaged, or of another type or size.
cv::Mat ReadImage(const std::filesystem::path& file, ImageType type, const Camera& camera,
                  const std::string& context);

/// Planar z in metres; 0 = no measurement: the reserved value 0 and the saturated 65535 both.
cv::Mat1f DepthInMetres(const cv::Mat& raw, double depth_factor);

}  // namespace slam
