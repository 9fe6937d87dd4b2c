#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "slam/base/random.h"
#include "slam/geometry/pose.h"
#include "slam/model/frame.h"
#include "tests/support/cameras.h"

namespace slam {

/// Printed pattern without repetition: blocks of three sizes, 8-bit, from a seed.
inline cv::Mat1b BlockPattern(int side_px, std::uint64_t seed) {
  cv::Mat1f sum(side_px, side_px, 0.0f);
  for (const int block_px : {4, 10, 32}) {
    const int blocks = side_px / block_px + 1;
    Random random{seed, static_cast<std::uint64_t>(block_px)};
    cv::Mat1f coarse(blocks, blocks);
    for (float& value : coarse) value = static_cast<float>(random.Below(256));
    cv::Mat1f fine;
    cv::resize(coarse, fine, cv::Size(blocks * block_px, blocks * block_px), 0, 0,
               cv::INTER_NEAREST);
    sum += fine(cv::Rect(0, 0, side_px, side_px)) / 3.0f;
  }
  cv::Mat1b pattern;
  sum.convertTo(pattern, CV_8U);
  cv::GaussianBlur(pattern, pattern, cv::Size(3, 3), 0.8);
  return pattern;
}

/// The corner of a room, whose three printed walls are seen from near the origin: z = 2 in
/// front, y = 0.7 below, x = 1.1 at the right. Depth is exact.
class TexturedCorner {
 public:
  /// @param repeat_texels  1024 is 14.6 m, which nobody sees; less is wallpaper
  explicit TexturedCorner(std::uint64_t seed = 1, int repeat_texels = 1024) {
    for (std::uint64_t wall = 0; wall < 3; ++wall) {
      const cv::Mat1b once = BlockPattern(repeat_texels, seed * 3 + wall);
      const int times = 1024 / repeat_texels;
      patterns_.push_back(cv::repeat(once, times, times));
    }
  }

  /// The frame as the camera sees it: `gray` and `depth_m` alone, no features.
  Frame See(const Camera& camera, const Pose& T_cw, int index) const {
    Frame frame;
    frame.index = index;
    frame.timestamp_s = index / camera.fps;
    frame.gray.create(camera.height, camera.width);
    frame.depth_m.create(camera.height, camera.width);
    const Pose T_wc = Inverse(T_cw);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray_w = T_wc.R * camera.Backproject({u, v}, 1.0);
        const Hit hit = Trace(T_wc.t, ray_w);
        frame.gray(v, u) = Print(hit.wall, T_wc.t + hit.z_m * ray_w);
        frame.depth_m(v, u) = static_cast<float>(hit.z_m);
      }
    }
    return frame;
  }

 private:
  struct Hit {
    int wall;
    double z_m;  ///< depth: the ray has z = 1 in the camera
  };
  static Hit Trace(const Eigen::Vector3d& origin_w, const Eigen::Vector3d& ray_w) {
    constexpr int kAxis[] = {2, 1, 0};
    constexpr double kOffset_m[] = {2.0, 0.7, 1.1};
    Hit nearest{0, 100.0};
    for (int wall = 0; wall < 3; ++wall) {
      const double speed = ray_w[kAxis[wall]];
      if (!(speed > 1e-9)) continue;
      const double z = (kOffset_m[wall] - origin_w[kAxis[wall]]) / speed;
      if (z > 0 && z < nearest.z_m) nearest = {wall, z};
    }
    return nearest;
  }
  std::uint8_t Print(int wall, const Eigen::Vector3d& p_w) const {
    constexpr double kTexelsAMetre = 70.0;  // coarser than any pixel: no aliasing
    const cv::Mat1b& pattern = patterns_[static_cast<std::size_t>(wall)];
    const double s = (wall == 2 ? p_w.z() : p_w.x()) * kTexelsAMetre + 512.0;
    const double t = (wall == 1 ? p_w.z() : p_w.y()) * kTexelsAMetre + 512.0;
    const int x = static_cast<int>(std::floor(s)), y = static_cast<int>(std::floor(t));
    const double a = s - x, b = t - y;
    const auto texel = [&](int i, int j) {  // the pattern goes on for ever
      return static_cast<double>(pattern((y + j) & 1023, (x + i) & 1023));
    };
    const double value = (1 - b) * ((1 - a) * texel(0, 0) + a * texel(1, 0)) +
                         b * ((1 - a) * texel(0, 1) + a * texel(1, 1));
    return static_cast<std::uint8_t>(std::lround(value));
  }

  std::vector<cv::Mat1b> patterns_;
};

/// T_cw of a hand that swings around the origin; at 30 frames a second at most 0.25 m/s.
inline Pose SwingingPose(int index) {
  const double a = 0.05 * index;
  const Eigen::Vector3d centre_w(0.12 * std::sin(a), 0.06 * std::sin(1.7 * a),
                                 0.08 * (1 - std::cos(a)));
  const Eigen::Matrix3d R_wc =
      ExpSo3({0.06 * std::sin(1.3 * a), 0.10 * std::sin(a), 0.04 * std::sin(0.8 * a)});
  return Inverse(Pose{R_wc, centre_w});
}

}  // namespace slam
