#pragma once

#include <string>
#include <vector>

#include "slam/bag/bag_file.h"

namespace slam {

/// The topics of a bag that make a sequence.
struct BagTopics {
  std::string colour, depth;            ///< sensor_msgs/Image
  std::string colour_info, depth_info;  ///< sensor_msgs/CameraInfo beside them; empty: none
  std::vector<std::string> warnings;    ///< topics that could have been taken, too
};

/// Chooses by what the images are, not by names that every driver chooses for itself. Colour is
/// 8-bit and, where there is such, of three channels; depth has 16 bits or is floating point;
/// infrared is neither. Of several, depth that is laid on colour, then of the same camera, then
/// what has most images is taken, and a warning names the others.
/// @throws InputError that lists the images there are, when one of the two is missing.
BagTopics ChooseTopics(const BagFile& bag);

/// Whether a topic's name says that its depth is laid on the colour image.
bool SaysRegistered(const std::string& topic);

/// Whether a topic is one of RealSense's library, "/device_0/sensor_0/Depth_0/image/data".
bool IsOfRealSense(const std::string& topic);

/// The topic with that end beside an image of RealSense's library: of its stream
/// ("info/camera_info").
std::string OfStream(const std::string& image_topic, const std::string& end);

}  // namespace slam
