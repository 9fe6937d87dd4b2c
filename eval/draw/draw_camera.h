#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eval {

/// Pinhole camera with the distortion of OpenCV, for drawing on recorded images.
struct DrawCamera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3

  /// Pixel of a point of the camera frame; nothing behind or beside the camera.
  std::optional<cv::Point2d> Project(const Eigen::Vector3d& p_c) const;
  /// A closed outline, cut at the near plane.
  std::vector<cv::Point2d> ProjectOutline(const std::vector<Eigen::Vector3d>& points_c) const;
};

/// `name` is tum1, tum2, tum3 or a camera.yaml. @throws InputError for anything else.
DrawCamera ReadDrawCamera(const std::string& name);

/// The camera of a run: `choice` when it is given, else SEQ/camera.yaml, else the camera that
/// run.json names. Nothing when none of them tells.
std::optional<DrawCamera> ChooseDrawCamera(const std::string& choice,
                                           const std::filesystem::path& sequence,
                                           const std::filesystem::path& run);

}  // namespace eval
