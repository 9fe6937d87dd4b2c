#pragma once

#include <cmath>

#include "slam/geometry/camera.h"

namespace slam {

/// Nearest recorded pixel of a point, or x < 0 when it is not in the picture in front of the
/// camera.
inline Eigen::Vector2i RecordedPixel(const Camera& camera, const Eigen::Vector3d& x_c) {
  Eigen::Vector2i none(-1, -1);
  if (!(x_c.z() > kMinVisibleDepth_m)) return none;
  // Far outside, the distortion polynomial folds back into the image: look at the ideal pixel
  // first.
  const Eigen::Vector2d ideal = camera.Project(x_c);
  constexpr double kMargin = 0.25;  // image widths: more than real lenses move a pixel
  const double margin = kMargin * camera.width;
  if (!(ideal.x() > -margin && ideal.x() < camera.width + margin && ideal.y() > -margin &&
        ideal.y() < camera.height + margin)) {
    return none;
  }
  const Eigen::Vector2d u = camera.distorted() ? camera.ProjectDistorted(x_c) : ideal;
  const Eigen::Vector2i pixel(static_cast<int>(std::lround(u.x())),
                              static_cast<int>(std::lround(u.y())));
  const bool inside =
      pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() < camera.width && pixel.y() < camera.height;
  return inside ? pixel : none;
}

}  // namespace slam
