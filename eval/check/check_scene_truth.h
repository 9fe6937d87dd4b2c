#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <vector>

#include "eval/check/fault.h"

namespace eval {

/// gt/scene.json as the checks of the truth images need it; world frame, metres.
struct CheckedScene {
  struct Plane {
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
    double d = 0;  ///< n . x + d = 0
    int object = 0;
    std::vector<Eigen::Vector3d> corners;  ///< in order; empty when they are at fault
    std::vector<std::vector<Eigen::Vector3d>> holes;  ///< a mesh's; their outlines
  };
  std::map<int, Plane> planes;
  std::map<int, Eigen::Vector3d> objects;  ///< id -> centre
};

/// Checks gt/scene.json: unique ids, known roles, unit normals out of the object, rectangles
/// (of a mesh: any outlines, with holes) that lie on their plane and in their object's box,
/// areas. Faulty planes and objects are left out of what is returned; nothing is returned when
/// there is no such file.
std::optional<CheckedScene> CheckSceneTruth(FolderCheck& check);

}  // namespace eval
