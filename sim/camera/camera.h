#pragma once

#include <Eigen/Core>
#include <string>

#include "sim/camera/lens.h"
#include "sim/scene/scene.h"

namespace sim {

/// The simulated camera: x right, y down, z forward, pixel centres at integer coordinates,
/// u = fx x'/z + cx with (x', y') the lens's distortion of (x/z, y/z), none by default. Colour
/// and depth share it: depth is registered to the distorted colour image.
struct Camera {
  int width = 640;                                        ///< pixels
  int height = 480;                                       ///< pixels
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  ///< pixels
  double fps = 30.0;
  double depth_factor = 5000.0;  ///< 16-bit units a metre
  Lens lens = {};                ///< set by WithLens

  /// Pixel of a point with z > 0, camera frame.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_c) const {
    if (lens.IsNone()) return {fx * x_c.x() / x_c.z() + cx, fy * x_c.y() / x_c.z() + cy};
    const Eigen::Vector2d bent = lens.Distort(x_c.head<2>() / x_c.z());
    return {fx * bent.x() + cx, fy * bent.y() + cy};
  }
  /// Ray (x/z, y/z, 1) of a pixel, camera frame.
  Eigen::Vector3d Ray(double u, double v) const {
    Eigen::Vector3d bent((u - cx) / fx, (v - cy) / fy, 1.0);
    if (lens.IsNone()) return bent;
    const Eigen::Vector2d ray = lens.Undistort(bent.head<2>());
    return {ray.x(), ray.y(), 1.0};
  }
};

/// The same field of view at another size: the image edges at -0.5 and width - 0.5 stay put.
/// @throws std::invalid_argument unless 16 <= width, height <= 8192.
Camera Resize(const Camera& camera, int width, int height);

/// The camera with a lens.
/// @throws io::InputError when the distortion folds the image, so that not every pixel,
///   and a rim of two pixels, has one ray.
Camera WithLens(const Camera& camera, const Lens& lens);

/// The camera that a scene asks for, with its lens.
/// @throws as Resize and WithLens do
Camera CameraOf(const Capture& capture);

/// Text of camera.yaml (formats.md).
std::string CameraYaml(const Camera& camera);

}  // namespace sim
