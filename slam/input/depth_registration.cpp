#include "slam/input/depth_registration.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "slam/base/require.h"

namespace slam {
namespace {

// A pixel of depth that falls on more colour pixels than this in one direction is seen from the
// side, or lies at the lens: it tells nothing of what is beside it. RealSense's widest ratio of
// resolutions is 1920 to 256, some 8.
constexpr double kMaxSpread_px = 10;

// Neighbours with other depths, and a turn between the cameras, leave gaps of a tenth of a pixel
// between their areas. Below half a pixel, so that depth of the same view stays as it is.
constexpr double kPadding_px = 0.25;

/// Where the corner of a pixel with depth z falls in the colour image, and its depth there.
struct Landed {
  Eigen::Vector2d u_px;
  double z_m;
};

std::optional<Landed> Land(const cv::Vec2d& ray, double z_m, const Pose& T_cd,
                           const Camera& colour) {
  const Eigen::Vector3d x_c = T_cd * Eigen::Vector3d(ray[0] * z_m, ray[1] * z_m, z_m);
  if (x_c.z() < kMinProjectedDepth_m) return std::nullopt;
  return Landed{colour.ProjectDistorted(x_c), x_c.z()};
}

/// The nearest depth counts.
void Put(double z_m, int u, int v, cv::Mat1f& depth_m) {
  float& there = depth_m(v, u);
  if (there == 0 || z_m < static_cast<double>(there)) there = static_cast<float>(z_m);
}

}  // namespace

DepthRegistration::DepthRegistration(const Camera& depth, const Camera& colour,
                                     const Pose& T_cd)
    : colour_(colour), T_cd_(T_cd), corner_rays_(depth.height + 1, depth.width + 1) {
  // Pixel centres are at whole numbers, so that a pixel's corners are half a pixel off.
  for (int v = 0; v <= depth.height; ++v) {
    for (int u = 0; u <= depth.width; ++u) {
      const Eigen::Vector3d ray = depth.Backproject(depth.Undistort({u - 0.5, v - 0.5}), 1.0);
      corner_rays_(v, u) = {ray.x(), ray.y()};
    }
  }
}

cv::Mat1f DepthRegistration::Register(const cv::Mat1f& depth_m) const {
  Require(depth_m.rows + 1 == corner_rays_.rows && depth_m.cols + 1 == corner_rays_.cols,
          "DepthRegistration: the image must be of the depth camera's size");
  cv::Mat1f laid(colour_.height, colour_.width, 0.0f);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double z_m = static_cast<double>(depth_m(v, u));
      if (!(z_m > 0)) continue;
      // The pixel's area in the colour image, from two of its corners.
      const auto first = Land(corner_rays_(v, u), z_m, T_cd_, colour_);
      const auto last = Land(corner_rays_(v + 1, u + 1), z_m, T_cd_, colour_);
      if (!first || !last) continue;
      const Eigen::Vector2d begin = first->u_px.cwiseMin(last->u_px);
      const Eigen::Vector2d end = first->u_px.cwiseMax(last->u_px);
      if (!((end - begin).maxCoeff() <= kMaxSpread_px)) continue;
      // All pixels whose centre is in it.
      const auto pixel = [](double at, int size) {
        return static_cast<int>(std::clamp(std::ceil(at), 0.0, static_cast<double>(size)));
      };
      const int right = pixel(end.x() + kPadding_px, laid.cols);
      const int bottom = pixel(end.y() + kPadding_px, laid.rows);
      for (int y = pixel(begin.y() - kPadding_px, laid.rows); y < bottom; ++y) {
        for (int x = pixel(begin.x() - kPadding_px, laid.cols); x < right; ++x) {
          Put(0.5 * (first->z_m + last->z_m), x, y, laid);
        }
      }
    }
  }
  return laid;
}

}  // namespace slam
