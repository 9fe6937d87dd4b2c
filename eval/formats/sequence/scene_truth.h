#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/plane.h"

namespace eval {

inline constexpr int kMaxId = 65535;  // of planes and objects: images have 16 bits, 0 is none

/// What an object is to the evaluation: truth planes of structure and regular objects are
/// scored.
enum class Role { kStructure, kRegular, kUnstructured, kOther };

/// An object of gt/scene.json; world frame g, metres.
struct TruthObject {
  int id = 0;
  std::string name;  ///< may be empty
  std::string object_class;
  Role role = Role::kOther;
  bool regular = false;
  Eigen::Vector3d center_g = Eigen::Vector3d::Zero();
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d R_go = Eigen::Matrix3d::Identity();
  int detection_group = 0;  ///< objects of one group are detected as one; 0 = alone
  bool is_mesh = false;     ///< its planes are any polygons, and need not face out of its box
};

/// A true plane: normal out of its object, polygon in order; world frame g, metres.
struct TruthPlane {
  int id = 0;
  int object = 0;
  Plane pi_g;
  double area_m2 = 0.0;
  std::vector<Eigen::Vector3d> vertices_g;
  std::vector<std::vector<Eigen::Vector3d>> holes_g;  ///< outlines; only a mesh has some
  bool scored = false;  ///< it belongs to a structure or regular object
};

/// gt/scene.json, format "pas-scene-gt/1"; planes and objects by rising id.
struct SceneTruth {
  std::vector<TruthObject> objects;
  std::vector<TruthPlane> planes;

  const TruthPlane* FindPlane(int id) const;    ///< null if there is none
  const TruthObject* FindObject(int id) const;  ///< null if there is none
};

/// Reads gt/scene.json and looks whether each face can be one (face_shape.h).
SceneTruth ReadSceneTruth(Folder& folder);

}  // namespace eval
