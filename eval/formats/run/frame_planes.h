#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/plane.h"

namespace eval {

/// A plane that the run found in one frame; camera frame c, metres.
struct RunFramePlane {
  int index = 0;  ///< pixel value in segmentation/ is index + 1
  Plane pi_c;
  Eigen::Vector3d centroid_c = Eigen::Vector3d::Zero();
  int pixels = 0;
  std::optional<std::string> plane_class;
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
  std::vector<RunFramePlane> planes;  ///< in the order of the file
  int line = 0;                       ///< in the file; 0 when it comes from none
};

/// Reads frame_planes.jsonl, by rising stamp.
std::vector<RunFrame> ReadRunFrames(Folder& folder);

}  // namespace eval
