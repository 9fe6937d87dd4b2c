#pragma once

#include <string>

#include "io/yaml_value.h"
#include "slam/geometry/camera.h"

namespace slam {

/// What a format calls the values of a camera, and where in the file each stands: as in a camera.yaml.
struct CameraKeys {
  std::string width = "width", height = "height";
  std::string fx = "fx", fy = "fy", cx = "cx", cy = "cy";
  std::string fps = "fps", depth_factor = "depth_factor";
  std::string k1 = "k1", k2 = "k2", p1 = "p1", p2 = "p2", k3 = "k3";
};

/// The values under these keys. `fps` and the lens may be missing; the default stays then.
/// @throws InputError with file:line
Camera CameraUnder(const io::YamlMap& map, const CameraKeys& keys = {});

/// The values of a calibration of OpenCV or ROS, whose matrices are lists, or of a CameraInfo
/// message of ROS as text.
/// @throws InputError with file:line
Camera CameraOfMatrices(const io::YamlMap& map);

}  // namespace slam
