#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <limits>
#include <opencv2/core/mat.hpp>
#include <string>
#include <vector>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "slam/geometry/plane.h"
#include "slam/geometry/pose.h"
#include "slam/model/frame.h"
#include "tests/support/normal_draws.h"

/// Depth images that need no renderer: rays against planes and boxes in closed form. World: z
/// up.
namespace closed_form {

/// A box standing in the world, turned about the vertical.
struct BoxBody {
  Eigen::Vector3d center_w;
  Eigen::Vector3d size_m;
  double yaw_rad = 0.0;
  std::string class_name;  ///< empty: not detected
};

struct World {
  std::vector<BoxBody> boxes;
};

/// What the camera sees: planar z (0 = nothing) and 1 + 6 box + face at each pixel (0 =
/// nothing). Faces: 0 -x, 1 +x, 2 -y, 3 +y, 4 bottom, 5 top.
struct View {
  cv::Mat1f depth_m;
  cv::Mat1i face;
};
inline int FaceId(int box, int face) { return 1 + 6 * box + face; }
inline constexpr int kTop = 5;

/// Camera at `eye_w` looking at `target_w`, image x to the right, y down.
inline slam::Pose LookAt(const Eigen::Vector3d& eye_w, const Eigen::Vector3d& target_w) {
  const Eigen::Vector3d z = (target_w - eye_w).normalized();
  const Eigen::Vector3d up =
      std::abs(z.z()) > 0.999 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d x = z.cross(up).normalized();
  slam::Pose T_wc;
  T_wc.R << x, z.cross(x), z;
  T_wc.t = eye_w;
  return slam::Inverse(T_wc);
}

inline Eigen::Matrix3d Yaw(const BoxBody& b) {
  return Eigen::AngleAxisd(b.yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

/// Plane of a face in the world, normal out of the box.
inline slam::Plane FacePlane(const BoxBody& b, int face) {
  Eigen::Vector3d n = Eigen::Vector3d::Zero();
  n[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
  const Eigen::Vector3d n_w = Yaw(b) * n;
  return {n_w, -n_w.dot(b.center_w) - 0.5 * b.size_m[face / 2]};
}

/// Corners of a top face, in order.
inline std::vector<Eigen::Vector3d> TopCorners(const BoxBody& b) {
  std::vector<Eigen::Vector3d> out;
  const double sign[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& s : sign) {
    out.push_back(b.center_w + Yaw(b) * Eigen::Vector3d(0.5 * s[0] * b.size_m.x(),
                                                        0.5 * s[1] * b.size_m.y(),
                                                        0.5 * b.size_m.z()));
  }
  return out;
}

/// Depth along `dir` (unit z component in the camera) at which the ray enters the box; slab
/// test.
inline double EnterBox(const Eigen::Vector3d& eye_b, const Eigen::Vector3d& dir_b,
                       const Eigen::Vector3d& half, int& face) {
  double in = 0.0, out = std::numeric_limits<double>::infinity();
  face = -1;
  for (int k = 0; k < 3; ++k) {
    if (dir_b[k] == 0.0) {
      if (std::abs(eye_b[k]) > half[k]) return 0.0;
      continue;
    }
    const double s = dir_b[k] > 0 ? -1.0 : 1.0;
    const double near = (s * half[k] - eye_b[k]) / dir_b[k];
    const double far = (-s * half[k] - eye_b[k]) / dir_b[k];
    if (near > in) in = near, face = 2 * k + (s > 0 ? 1 : 0);
    out = std::min(out, far);
  }
  return face >= 0 && in < out ? in : 0.0;
}

inline View Render(const World& world, const slam::Camera& camera, const slam::Pose& T_cw) {
  const slam::Pose T_wc = slam::Inverse(T_cw);
  const cv::Mat2d rays = slam::PixelRays(camera);
  View view{cv::Mat1f(camera.height, camera.width, 0.0f),
            cv::Mat1i(camera.height, camera.width, 0)};
  for (std::size_t k = 0; k < world.boxes.size(); ++k) {
    const BoxBody& box = world.boxes[k];
    const Eigen::Matrix3d R_bw = Yaw(box).transpose();
    const Eigen::Vector3d eye_b = R_bw * (T_wc.t - box.center_w), half = 0.5 * box.size_m;
    const Eigen::Matrix3d R_bc = R_bw * T_wc.R;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const cv::Vec2d& ray = rays(v, u);
        int face = -1;
        const double z =
            EnterBox(eye_b, R_bc * Eigen::Vector3d(ray[0], ray[1], 1.0), half, face);
        float& nearest = view.depth_m(v, u);
        if (z > 0 && (nearest == 0.0f || z < static_cast<double>(nearest))) {
          nearest = static_cast<float>(z);
          view.face(v, u) = FaceId(static_cast<int>(k), face);
        }
      }
    }
  }
  return view;
}

/// Adds the errors of a first-generation Kinect: disparity noise that is correlated over 3 x 3
/// pixels and rounded to 1/8 pixel, so that the total follows Nguyen's curve.
inline cv::Mat1f AddKinectNoise(const cv::Mat1f& depth_m, std::uint64_t seed) {
  constexpr double kUnits = 351.3;  // 8 f b: disparity in 1/8 px = kUnits / z
  slam::Random random({seed, 77});
  const int w = depth_m.cols, h = depth_m.rows;
  cv::Mat1d white(h + 2, w + 2);
  for (double& value : white) value = slam::BoundedNormal(random);
  cv::Mat1f out(h, w, 0.0f);
  for (int v = 0; v < h; ++v) {
    for (int u = 0; u < w; ++u) {
      const double z = static_cast<double>(depth_m(v, u));
      if (!(z > 0)) continue;
      double noise = 0.0;
      for (int k = 0; k < 9; ++k) noise += white(v + k / 3, u + k % 3) / 3.0;
      const double sigma_z = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);
      const double sigma_units = sigma_z * kUnits / (z * z);
      const double drawn =
          std::sqrt(std::max(sigma_units * sigma_units - 1.0 / 12.0, 1.0 / 36.0));
      out(v, u) = static_cast<float>(kUnits / std::round(kUnits / z + drawn * noise));
    }
  }
  return out;
}

/// 16-bit depth files hold 1/5000 m.
inline cv::Mat1f Quantise16(const cv::Mat1f& depth_m) {
  cv::Mat1f out = depth_m.clone();
  for (float& z : out) z = std::round(z * 5000.0f) / 5000.0f;
  return out;
}

inline slam::Frame MakeFrame(const cv::Mat1f& depth_m) {
  slam::Frame frame;
  frame.depth_m = depth_m;
  return frame;
}

/// A desk top 1.4 x 0.8 m at height 0 with nothing on it.
inline World Desk() {
  return {{{Eigen::Vector3d(0, 0, -0.015), Eigen::Vector3d(1.4, 0.8, 0.03), 0.0, ""}}};
}

/// Puts a box on the desk at (x, y).
inline void PutOnDesk(World& world, double x, double y, const Eigen::Vector3d& size_m,
                      double yaw_rad, const std::string& class_name) {
  world.boxes.push_back({Eigen::Vector3d(x, y, 0.5 * size_m.z()), size_m, yaw_rad, class_name});
}

}  // namespace closed_form
