#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "eval/read/plane.h"

namespace eval {

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
};

/// A true plane: normal out of its object, polygon in order; world frame g, metres.
struct TruthPlane {
  int id = 0;
  int object = 0;
  Plane pi_g;
  double area_m2 = 0.0;
  std::vector<Eigen::Vector3d> vertices_g;
  bool scored = false;  ///< it belongs to a structure or regular object
};

/// gt/scene.json, format "pas-scene-gt/1"; planes and objects by rising id.
struct SceneTruth {
  std::vector<TruthObject> objects;
  std::vector<TruthPlane> planes;

  const TruthPlane* FindPlane(int id) const;    ///< null if there is none
  const TruthObject* FindObject(int id) const;  ///< null if there is none
};

/// What of the scene one frame shows (gt/frames.jsonl). Boxes are [x0, y0, x1, y1] in pixels.
struct VisibleObject {
  int id = 0;
  int pixels = 0;
  std::optional<std::array<double, 4>> visible_box_px, amodal_box_px;
  double visible_fraction = 0.0;
};
struct VisiblePlane {
  int id = 0;
  int pixels = 0;
};
struct FrameTruth {
  double stamp_s = 0.0;
  std::vector<VisibleObject> objects;
  std::vector<VisiblePlane> planes;
};

/// @throws InputError naming the file and the key.
SceneTruth ReadSceneTruth(const std::filesystem::path& file);
/// By rising stamp. @throws InputError with file:line.
std::vector<FrameTruth> ReadFrameTruth(const std::filesystem::path& file);

}  // namespace eval
