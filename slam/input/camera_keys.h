#pragma once

#include <string>

#include "io/yaml_value.h"
#include "slam/geometry/camera.h"

namespace slam {

/// What a format calls the values of a camera, and where in the file each stands.
struct CameraKeys {
  std::string width, height, fx, fy, cx, cy;
  std::string fps, depth_factor;
  std::string k1, k2, p1, p2, k3;
};

/// The values under these keys. `fps` and the lens may be missing; the default stays then.
/// @throws InputError with file:line
Camera CameraUnder(const io::YamlMap& map, const CameraKeys& keys);

/// The values of a calibration of OpenCV or ROS, whose matrices are lists, or of a CameraInfo
/// message of ROS as text.
/// @throws InputError with file:line
Camera CameraOfMatrices(const io::YamlMap& map);

}  // namespace slam
