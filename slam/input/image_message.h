#pragma once

#include <opencv2/core/mat.hpp>
#include <string>

#include "slam/bag/bag_file.h"

namespace slam {

/// The pixels of a colour image: rgb8, bgr8, 8UC3 (as bgr8), rgba8, bgra8, mono8 and 8UC1.
/// @param where  of the image, for messages
/// @throws InputError for another encoding or size, and for too few bytes
cv::Mat3b BgrOf(const BagImage& image, cv::Size size, const std::string& where);

/// Planar z in metres of a depth image: 32FC1 in metres, 16UC1 and mono16 in units of which
/// `depth_factor` make a metre. 0 = no measurement, as are numbers that are not finite.
/// @throws InputError as BgrOf
cv::Mat1f DepthOf(const BagImage& image, cv::Size size, double depth_factor,
                  const std::string& where);

}  // namespace slam
