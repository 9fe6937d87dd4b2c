#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/camera/camera.h"

namespace sim {

/// Bounds of the image's rays (x, y, 1), two pixels of rim included.
struct RayWindow {
  Eigen::Vector2d low, high;
};

/// The rays (x, y, 1) of a camera's pixels, camera frame, the very bits of Camera::Ray; what a
/// lens costs is paid once.
class ImageRays {
 public:
  explicit ImageRays(const Camera& camera);

  /// x and y of the `width` pixels of row v.
  void Row(int v, double* x, double* y) const { Stretch(v, 0, camera_.width, x, y); }
  /// The same of its pixels from first to last, without that one.
  void Stretch(int v, int first, int last, double* x, double* y) const;
  Eigen::Vector3d At(int u, int v) const;
  /// Ray of (u + du, v + dv), at most half a pixel from a pixel's centre; behind a lens to
  /// first order.
  Eigen::Vector3d Beside(int u, int v, double du, double dv) const;
  const RayWindow& Window() const { return window_; }

 private:
  void Bound();

  Camera camera_;
  RayWindow window_;
  std::vector<double> x_, y_;  ///< a row and a column; with a lens one a pixel
};

}  // namespace sim
