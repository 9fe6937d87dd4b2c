#include "slam/geometry/camera.h"

#include <Eigen/LU>
#include <string_view>

#include "io/input_error.h"

namespace slam {
namespace {

/// Brown's model on the normalised plane.
Eigen::Vector2d Distort(const Camera& c, const Eigen::Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  return {x.x() * radial + 2.0 * c.p1 * x.x() * x.y() + c.p2 * (r2 + 2.0 * x.x() * x.x()),
          x.y() * radial + c.p1 * (r2 + 2.0 * x.y() * x.y()) + 2.0 * c.p2 * x.x() * x.y()};
}

/// Its derivatives, which are symmetric.
Eigen::Matrix2d DistortJacobian(const Camera& c, const Eigen::Vector2d& x) {
  const double r2 = x.squaredNorm();
  const double radial = 1.0 + r2 * (c.k1 + r2 * (c.k2 + r2 * c.k3));
  const double by_r2 = 2.0 * (c.k1 + r2 * (2.0 * c.k2 + 3.0 * r2 * c.k3));
  const double across = x.x() * x.y() * by_r2 + 2.0 * (c.p1 * x.x() + c.p2 * x.y());
  Eigen::Matrix2d J;
  J << radial + x.x() * x.x() * by_r2 + 2.0 * c.p1 * x.y() + 6.0 * c.p2 * x.x(), across,  //
      across, radial + x.y() * x.y() * by_r2 + 6.0 * c.p1 * x.y() + 2.0 * c.p2 * x.x();
  return J;
}

}  // namespace

Eigen::Vector2d Camera::ProjectDistorted(const Eigen::Vector3d& x_c) const {
  Eigen::Vector2d x(x_c.x() / x_c.z(), x_c.y() / x_c.z());
  if (distorted()) x = Distort(*this, x);
  return {fx * x.x() + cx, fy * x.y() + cy};
}

Eigen::Matrix<double, 2, 3> Camera::ProjectDistortedJacobian(const Eigen::Vector3d& x_c) const {
  const double iz = 1.0 / x_c.z(), x = x_c.x() * iz, y = x_c.y() * iz;
  Eigen::Matrix<double, 2, 3> J;
  J << iz, 0, -x * iz,  //
      0, iz, -y * iz;
  if (distorted()) J = DistortJacobian(*this, {x, y}) * J;
  return Eigen::Vector2d(fx, fy).asDiagonal() * J;
}

Eigen::Vector2d Camera::Undistort(const Eigen::Vector2d& u_px) const {
  if (!distorted()) return u_px;
  const Eigen::Vector2d measured((u_px.x() - cx) / fx, (u_px.y() - cy) / fy);
  // Newton's method on Distort(x) = measured; where the lens folds the image over, by the step alone.
  constexpr int kMaxIterations = 50;
  constexpr double kMinStep2 = 1e-24;  // of the normalised plane: 1e-9 pixels
  Eigen::Vector2d x = measured;
  for (int i = 0; i < kMaxIterations; ++i) {
    const Eigen::Vector2d off = measured - Distort(*this, x);
    const Eigen::Matrix2d J = DistortJacobian(*this, x);
    const double det = J.determinant();
    const Eigen::Vector2d step = det > 0 ? Eigen::Vector2d(J.inverse() * off) : off;
    x += step;
    if (step.squaredNorm() < kMinStep2) break;
  }
  return {fx * x.x() + cx, fy * x.y() + cy};
}

Camera TumCamera(const char* name) {
  const std::string_view key(name);
  Camera c;
  if (key == "tum1") {
    c.fx = 517.306408, c.fy = 516.469215, c.cx = 318.643040, c.cy = 255.313989;
    c.k1 = 0.262383, c.k2 = -0.953104, c.p1 = -0.005358, c.p2 = 0.002628, c.k3 = 1.163314;
  } else if (key == "tum2") {
    c.fx = 520.908620, c.fy = 521.007327, c.cx = 325.141442, c.cy = 249.701764;
    c.k1 = 0.231222, c.k2 = -0.784899, c.p1 = -0.003257, c.p2 = -0.000105, c.k3 = 0.917205;
  } else if (key == "tum3") {
    c.fx = 535.4, c.fy = 539.2, c.cx = 320.1, c.cy = 247.6;
  } else {
    throw io::InputError("--camera " + std::string(name),
                         "unknown camera; expected tum1, tum2, tum3 or a camera.yaml");
  }
  return c;
}

cv::Mat2d PixelRays(const Camera& camera) {
  cv::Mat2d rays(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d ideal = camera.Undistort({u, v});
      rays(v, u) = {(ideal.x() - camera.cx) / camera.fx, (ideal.y() - camera.cy) / camera.fy};
    }
  }
  return rays;
}

}  // namespace slam
