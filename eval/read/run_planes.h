#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/read/plane.h"

namespace eval {

/// A plane that the run found in one frame; camera frame c, metres.
struct RunFramePlane {
  int index = 0;  ///< pixel value in segmentation/ is index + 1
  Plane pi_c;
  Eigen::Vector3d centroid_c = Eigen::Vector3d::Zero();
  int pixels = 0;
  std::optional<double> inlier_ratio;
  std::optional<std::string> plane_class;
  std::optional<int> detection;
  std::optional<std::string> bad;  ///< why the run does not trust it; empty if it does
  std::vector<std::array<Eigen::Vector3d, 2>> lines_c;  ///< point and direction
  std::vector<Eigen::Vector3d> vertices_c;
  std::optional<int> map_plane;
  std::string decision;  ///< matched, new or none, as decided at this frame
  std::optional<std::string> by;
};

/// A line of frame_planes.jsonl.
struct RunFrame {
  double stamp_s = 0.0;
  std::vector<RunFramePlane> planes;
};

/// A plane of map.json; world frame w of the run, metres.
struct RunMapPlane {
  int id = 0;
  std::optional<std::string> plane_class;
  Plane pi_w;
  double area_m2 = 0.0;
  int observations = 0;
  std::optional<double> first_seen, last_seen;
  std::optional<int> merged_into;  ///< not a plane of the final map any more
  std::vector<Eigen::Vector3d> vertices_w;
  std::vector<Eigen::Vector3d> hull_w;
};

/// By rising stamp. @throws InputError with file:line.
std::vector<RunFrame> ReadRunFrames(const std::filesystem::path& file);
/// By rising id. @throws InputError naming the file and the key.
std::vector<RunMapPlane> ReadRunMap(const std::filesystem::path& file);

}  // namespace eval
