#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/plane.h"

namespace eval {

/// A plane of map.json; world frame w of the run, metres.
struct RunMapPlane {
  int id = 0;
  std::optional<std::string> plane_class;
  Plane pi_w;
  /// Of (n, d), upper triangle row by row in the file: n . x + d at a point x of the plane has the
  /// variance (x, 1)^T C (x, 1), m^2.
  std::optional<Eigen::Matrix4d> covariance;
  double area_m2 = 0.0;
  int observations = 0;
  std::optional<int> merged_into;  ///< not a plane of the final map any more
  std::optional<int> split_from;   ///< the plane that turned out to hold this one as well
  std::vector<Eigen::Vector3d> vertices_w;
  std::vector<Eigen::Vector3d> hull_w;
};

/// Reads map.json, by rising id. Nothing is returned when there is no list of planes.
std::optional<std::vector<RunMapPlane>> ReadRunMap(Folder& folder);

}  // namespace eval
