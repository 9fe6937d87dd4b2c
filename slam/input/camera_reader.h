#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "slam/geometry/camera.h"

namespace slam {

/// A camera as a file gives it.
struct CameraFile {
  Camera camera;
  std::vector<std::string> warnings;  ///< what the file leaves open, a line a key
};

/// Reads a camera from one of
/// - a camera.yaml (formats.md): width, height, fx, fy, cx, cy, depth_factor; model (pinhole)
///   and fps, without which there is a warning; Brown's k1 k2 p1 p2 k3, 0 where absent;
/// - settings of ORB-SLAM2 or 3: Camera.fx or Camera1.fx, Camera.width, DepthMapFactor or
///   RGBD.DepthMapFactor ...; what is not about the camera is passed over;
/// - a calibration of OpenCV or ROS: image_width, camera_matrix, distortion_coefficients ..., or
///   a CameraInfo message as `rostopic echo` prints it: width, K, D ... (ROS 2: k, d); to both
///   depth_factor has to be added.
/// @throws InputError with file:line for a missing or impossible value, a camera that is no
///   pinhole, and an unknown key of a camera.yaml.
CameraFile ReadCamera(const std::filesystem::path& file);

/// The camera of a run: `choice` is tum1, tum2, tum3, a file, or empty for SEQ/camera.yaml, or
/// the CameraInfo of a bag.
/// @throws InputError; without either it says to pass --camera.
CameraFile ChooseCamera(const std::string& choice, const std::filesystem::path& sequence);

}  // namespace slam
