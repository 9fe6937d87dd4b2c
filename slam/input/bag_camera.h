#pragma once

#include <filesystem>
#include <string>

#include "slam/bag/bag_file.h"
#include "slam/geometry/camera.h"
#include "slam/input/bag_topics.h"

namespace slam {

/// The camera of a CameraInfo: plumb_bob, or of RealSense's library, whose inverse Brown model
/// is turned into Brown's, which fits it to less than half a pixel or is refused.
/// @param image_topic  where its images are; of rectified ones the projection matrix counts
/// @throws InputError for values that no camera has, and for other lenses
Camera CameraOfInfo(const BagFile& bag, const std::string& info_topic,
                    const std::string& image_topic);

/// 16-bit units of depth a metre: millimetres (REP 118), or what RealSense's library has written
/// beside it. Of 32FC1, which needs none, the unit in which to write it to a PNG.
/// @throws InputError for a unit that is none
double DepthFactorOf(const BagFile& bag, const BagTopics& topics);

/// The colour camera of a bag, with its DepthFactorOf.
/// @throws InputError; without CameraInfo it says to pass --camera.
Camera CameraOfBag(const std::filesystem::path& file);

}  // namespace slam
