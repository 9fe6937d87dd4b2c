#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "eval/formats/sequence/sequence.h"
#include "io/atomic_file.h"
#include "io/number_text.h"
#include "tests/support/image_files.h"

/// Rectangular boards before a moving camera, as a sequence folder with exact depth: written by
/// ray casting, so that surfaces are tested against geometry and not against themselves.
namespace eval::testing {

struct Board {
  Eigen::Vector3d middle_g, half_u, half_v;  ///< half sides; the front is half_u x half_v
};

class BoardWorld {
 public:
  static constexpr int kWidth = 320, kHeight = 240, kFrames = 16;
  static constexpr double kFocal = 280.0, kFactor = 10000.0;  // a tenth of a millimetre

  std::vector<Board> boards;
  Pose T_wg;  ///< a motion of the whole world, camera and all
  /// What the device makes of a depth, by pixel and frame.
  std::function<double(double depth_m, int u, int v)> measured = [](double z, int, int) {
    return z;
  };

  /// The camera looks along +z and moves sideways.
  static Pose CameraAt(int frame) {
    const double angle = 0.25 * std::sin(0.7 * frame);
    return {Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix(),
            {-2.0 * std::sin(angle) + 0.02 * frame, 0.05 * std::cos(frame), 0.0}};
  }

  cv::Mat1w Depth(int frame) const {
    const Pose T_gc = CameraAt(frame);
    cv::Mat1w image(kHeight, kWidth, std::uint16_t(0));
    for (int v = 0; v < kHeight; ++v) {
      for (int u = 0; u < kWidth; ++u) {
        const Eigen::Vector3d ray_c((u - 0.5 * (kWidth - 1)) / kFocal,
                                    (v - 0.5 * (kHeight - 1)) / kFocal, 1.0);
        const double z = Nearest(T_gc.t, T_gc.R * ray_c);
        if (std::isfinite(z))
          image(v, u) = std::uint16_t(std::lround(kFactor * measured(z, u, v)));
      }
    }
    return image;
  }

  /// Writes the folder and reads it again.
  Sequence Write(const std::filesystem::path& folder) const {
    std::filesystem::create_directories(folder / "depth");
    std::string truth, list;
    for (int i = 0; i < kFrames; ++i) {
      const std::string t = io::NumberText(i / 30.0);
      const Pose T = T_wg * CameraAt(i);
      const Eigen::Quaterniond q(T.R);
      truth += t;
      for (const double x : {T.t.x(), T.t.y(), T.t.z(), q.x(), q.y(), q.z(), q.w()}) {
        truth += " " + io::NumberText(x);
      }
      truth += "\n";
      list += t + " rgb/" + t + ".png " + t + " depth/" + t + ".png\n";
      test_support::WriteImageFile(folder / "depth" / (t + ".png"), Depth(i));
    }
    io::WriteFile(folder / "groundtruth.txt", truth);
    io::WriteFile(folder / "associations.txt", list);
    io::WriteFile(folder / "camera.yaml",
                  "model: pinhole\nwidth: 320\nheight: 240\nfx: 280\nfy: 280\ncx: 159.5\n"
                  "cy: 119.5\nfps: 30\ndepth_factor: 10000\n");
    return ReadSequence(folder);
  }

 private:
  double Nearest(const Eigen::Vector3d& eye, const Eigen::Vector3d& ray) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Board& board : boards) {
      const Eigen::Vector3d n = board.half_u.cross(board.half_v).normalized();
      const double depth = n.dot(board.middle_g - eye) / n.dot(ray);
      const Eigen::Vector3d off = eye + depth * ray - board.middle_g;
      if (!(depth > 0) || std::abs(off.dot(board.half_u)) > board.half_u.squaredNorm() ||
          std::abs(off.dot(board.half_v)) > board.half_v.squaredNorm()) {
        continue;
      }
      nearest = std::min(nearest, depth);
    }
    return nearest;
  }
};

}  // namespace eval::testing
