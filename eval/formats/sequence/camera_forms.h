#pragma once

#include <optional>

#include "eval/formats/sequence/camera.h"
#include "io/yaml_value.h"

namespace eval {

/// A camera in the form of ORB-SLAM2 or 3, of OpenCV or of ROS, as `pas slam` takes it
/// (docs/cameras.md); nothing where the file is in none of them. Without a rate it is 30.
/// @throws InputError with file:line
std::optional<Camera> CameraOfOtherForm(const io::YamlMap& map);

}  // namespace eval
