#include "sim/sensor/depth/corner_glow.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

namespace sim {
namespace {

constexpr double kTouch_px = 3.0;    ///< planes nearer than this at the corner touch
constexpr double kMinPixels = 6;     ///< to know a plane by
constexpr double kMinSpread = 1e-6;  ///< smaller over larger variance of its rays

/// Sums over a plane's pixels of ray (x, y) and inverse depth w.
struct Sums {
  double count = 0;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d square = Eigen::Matrix3d::Zero();

  void Add(const Eigen::Vector3d& xyw) {
    count += 1;
    sum += xyw;
    square += xyw * xyw.transpose();
  }
  /// q with 1/z = q . ray, zero when the pixels do not tell.
  Eigen::Vector3d Plane() const {
    if (count < kMinPixels) return Eigen::Vector3d::Zero();
    // Least squares: in a plane, inverse depth is affine in the ray (x, y).
    const Eigen::Vector3d mean = sum / count;
    const Eigen::Matrix3d spread = square / count - mean * mean.transpose();
    const Eigen::Matrix2d rays = spread.topLeftCorner<2, 2>();
    const double trace = rays.trace();
    if (!(rays.determinant() > kMinSpread * trace * trace)) return Eigen::Vector3d::Zero();
    const Eigen::Vector2d slope = rays.inverse() * spread.topRightCorner<2, 1>();
    return {slope.x(), slope.y(), mean.z() - slope.dot(mean.head<2>())};
  }
};

struct Corner {
  Eigen::Vector3d p_c;
  ushort planes[2];
  float strength;
};

class CornerFinder {
 public:
  CornerFinder(const Rendering& rendering, const Camera& camera)
      : rendering_(rendering), camera_(camera), away_(rendering.depth_m.size(), uchar{255}) {
    FitPlanes();
    const cv::Size size = rendering.depth_m.size();
    for (int v = 0; v < size.height; ++v) {
      for (int u = 0; u < size.width; ++u) {
        if (u + 1 < size.width) Look({u, v}, {u + 1, v});
        if (v + 1 < size.height) Look({u, v}, {u, v + 1});
      }
    }
  }

  cv::Mat1f Glow(double reach_m) const {
    cv::Mat1f glow(away_.size(), 0.0F);
    if (corners_.empty()) return glow;
    cv::Mat1f distance_px;
    cv::Mat1i label;
    // Each pixel takes the light of the nearest corner in the image.
    cv::distanceTransform(away_, distance_px, label, cv::DIST_L2, cv::DIST_MASK_5,
                          cv::DIST_LABEL_PIXEL);
    std::map<int, const Corner*> of_label;
    for (const auto& [at, corner] : corners_) of_label[label(at.second, at.first)] = &corner;
    for (int v = 0; v < glow.rows; ++v) {
      for (int u = 0; u < glow.cols; ++u) {
        const double z = rendering_.depth_m(v, u);
        if (!(z > 0) || static_cast<double>(distance_px(v, u)) * z > 2 * reach_m * camera_.fx) {
          continue;
        }
        const Corner& corner = *of_label.at(label(v, u));
        const ushort plane = rendering_.plane_id(v, u);
        if (plane != corner.planes[0] && plane != corner.planes[1]) continue;
        const double far = (Point({u, v}) - corner.p_c).norm() / reach_m;
        glow(v, u) = corner.strength * static_cast<float>(std::max(0.0, 1.0 - far));
      }
    }
    return glow;
  }

 private:
  Eigen::Vector3d Point(cv::Point at) const {
    return rendering_.depth_m(at) * camera_.Ray(at.x, at.y);
  }

  void FitPlanes() {
    std::map<ushort, Sums> sums;
    for (int v = 0; v < rendering_.depth_m.rows; ++v) {
      ushort last = 0;
      Sums* into = nullptr;
      for (int u = 0; u < rendering_.depth_m.cols; ++u) {
        const ushort plane = rendering_.plane_id(v, u);
        if (plane == 0) continue;
        if (plane != last || into == nullptr) into = &sums[plane];
        last = plane;
        const Eigen::Vector3d ray = camera_.Ray(u, v);
        into->Add({ray.x(), ray.y(), 1.0 / rendering_.depth_m(v, u)});
      }
    }
    for (const auto& [plane, sum] : sums) planes_[plane] = sum.Plane();
  }

  /// Notes a corner between two neighbouring pixels, if there is one.
  void Look(cv::Point a, cv::Point b) {
    const ushort plane_a = rendering_.plane_id(a), plane_b = rendering_.plane_id(b);
    if (plane_a == plane_b || plane_a == 0 || plane_b == 0) return;
    const Eigen::Vector3d& q_a = planes_.at(plane_a);
    const Eigen::Vector3d& q_b = planes_.at(plane_b);
    if (q_a.isZero() || q_b.isZero()) return;
    // A corner is hollow when each face has the other's pixel before it, and they touch when it
    // is hardly before it. q . p < 1 on the camera's side of a plane.
    const Eigen::Vector3d p_a = Point(a), p_b = Point(b);
    const double a_before_b = (1.0 - q_b.dot(p_a)) / q_b.norm();
    const double b_before_a = (1.0 - q_a.dot(p_b)) / q_a.norm();
    const auto touch_m = [&](cv::Point at) {
      const double cosine = std::max(0.1F, rendering_.incidence_cos(at));
      return kTouch_px * rendering_.depth_m(at) / (camera_.fx * cosine);
    };
    if (!(a_before_b > 0 && a_before_b < touch_m(a))) return;
    if (!(b_before_a > 0 && b_before_a < touch_m(b))) return;
    const double cosine = q_a.dot(q_b) / (q_a.norm() * q_b.norm());
    const auto strength = static_cast<float>(std::clamp(1.0 - cosine, 0.0, 1.0));
    for (const cv::Point at : {a, b}) {
      away_(at) = 0;
      corners_[{at.x, at.y}] = {Point(at), {plane_a, plane_b}, strength};
    }
  }

  const Rendering& rendering_;
  const Camera& camera_;
  cv::Mat1b away_;  ///< 0 at corners
  std::map<ushort, Eigen::Vector3d> planes_;
  std::map<std::pair<int, int>, Corner> corners_;
};

}  // namespace

cv::Mat1f CornerGlow(const Rendering& rendering, const Camera& camera, double reach_m) {
  return CornerFinder(rendering, camera).Glow(reach_m);
}

}  // namespace sim
