#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "eval/formats/pose/pose.h"
#include "eval/formats/sequence/camera.h"

namespace eval {

/// How a depth camera stands to the colour camera, for recordings whose depth is not laid on
/// colour.
struct DepthRegistration {
  Camera depth, colour;  ///< width, height, fx, fy, cx, cy; the colour camera's lens as well
  Pose T_colour_depth;   ///< x_colour = R x_depth + t, metres
};

/// Reads the file of `--depth-registration`: keys depth, colour, translation, rotation.
/// @throws InputError with file:line
DepthRegistration ReadDepthRegistration(const std::filesystem::path& file);

/// The depth image as the colour camera sees it; where two depths meet in a pixel the nearer
/// one stays, where none does there is 0. What lies so far aside that the lens's model would fold
/// it back into the image is left out.
/// @param depth_m  metres, of the size of registration.depth
cv::Mat1f LayOnColour(const cv::Mat1f& depth_m, const DepthRegistration& registration);

}  // namespace eval
