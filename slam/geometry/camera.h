#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/geometry/box.h"

namespace slam {

/// A point nearer to the image plane has no projection: 1 / z and its derivatives would rule
/// every sum that they enter.
inline constexpr double kMinProjectedDepth_m = 0.01;

/// Nearer than any depth camera measures: what lies there is not in the picture.
inline constexpr double kMinVisibleDepth_m = 0.05;

/// Pinhole camera with Brown's distortion. x right, y down, z forward; pixel centres at integer
/// coordinates: u = fx x/z + cx before distortion. Depth images hold planar z, registered to
/// the (distorted) colour image.
struct Camera {
  int width = 640;                                        ///< pixels
  int height = 480;                                       ///< pixels
  double fx = 525.0, fy = 525.0, cx = 319.5, cy = 239.5;  ///< pixels
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;          ///< Brown, OpenCV's order
  double depth_factor = 5000.0;                           ///< 16-bit units a metre
  double fps = 30.0;

  bool distorted() const { return k1 != 0 || k2 != 0 || p1 != 0 || p2 != 0 || k3 != 0; }

  /// Ideal (undistorted) pixel of a point with z > 0.
  Eigen::Vector2d Project(const Eigen::Vector3d& x_c) const {
    return {fx * x_c.x() / x_c.z() + cx, fy * x_c.y() / x_c.z() + cy};
  }
  /// Pixel in the image as recorded, distortion applied; for detection boxes and drawing.
  Eigen::Vector2d ProjectDistorted(const Eigen::Vector3d& x_c) const;
  /// Its derivative by x_c, pixels per metre.
  Eigen::Matrix<double, 2, 3> ProjectDistortedJacobian(const Eigen::Vector3d& x_c) const;
  /// Ideal pixel of a recorded pixel (iterative inverse of the distortion).
  Eigen::Vector2d Undistort(const Eigen::Vector2d& u_px) const;
  /// Point at depth z_m on the ray of an ideal pixel.
  Eigen::Vector3d Backproject(const Eigen::Vector2d& u_px, double z_m) const {
    return {(u_px.x() - cx) / fx * z_m, (u_px.y() - cy) / fy * z_m, z_m};
  }
  /// Where a row lies between the middle of the image (0) and its last row (0.5).
  double RowShare(double v_px) const { return v_px / (height - 1) - 0.5; }
  /// The whole image as a box of pixel centres.
  Box ImageBox() const {
    return {Eigen::Vector2d(0, 0), Eigen::Vector2d(width - 1, height - 1)};
  }
};

/// TUM RGB-D's published calibrations, "tum1", "tum2", "tum3" (fr1, fr2, fr3).
/// @throws InputError for another name.
Camera TumCamera(const char* name);

/// Rays (x/z, y/z) of every recorded pixel, distortion removed: CV_64FC2, height x width. A
/// pixel of depth z is the point (ray.x z, ray.y z, z). Build once a camera.
cv::Mat2d PixelRays(const Camera& camera);

}  // namespace slam
