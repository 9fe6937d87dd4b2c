#pragma once

#include <Eigen/Core>
#include <string>

namespace sim {

/// The simulated pinhole camera: no distortion, x right, y down, z forward, pixel centres at
/// integer coordinates: u = fx x/z + cx. Colour and depth share it.
struct Camera {
  int width = 640;                                        ///< pixels
  int height = 480;                                       ///< pixels
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  ///< pixels
  double fps = 30.0;
  double depth_factor = 5000.0;  ///< 16-bit units a metre

  /// Pixel of a point with z > 0, camera frame.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_c) const {
    return {fx * x_c.x() / x_c.z() + cx, fy * x_c.y() / x_c.z() + cy};
  }
  /// Ray (x/z, y/z, 1) of a pixel, camera frame.
  Eigen::Vector3d Ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
};

/// The same field of view at another size: the image edges at -0.5 and width - 0.5 stay put.
/// @throws std::invalid_argument unless 16 <= width, height <= 8192.
Camera Resize(const Camera& camera, int width, int height);

/// Text of camera.yaml (formats.md).
std::string CameraYaml(const Camera& camera);

}  // namespace sim
