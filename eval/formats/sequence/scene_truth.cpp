#include "eval/formats/sequence/scene_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "eval/formats/plane_record.h"
#include "eval/formats/sequence/face_shape.h"

namespace eval {
namespace {

constexpr const char* kFile = "gt/scene.json";

template <typename Entry>
const Entry* FindById(const std::vector<Entry>& entries, int id) {
  const auto found = std::lower_bound(entries.begin(), entries.end(), id,
                                      [](const Entry& e, int i) { return e.id < i; });
  return found != entries.end() && found->id == id ? &*found : nullptr;
}

template <typename Entry>
void SortById(std::vector<Entry>& entries) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
}

/// An id that no other one of its list has.
std::optional<int> ReadId(const JsonRecord& record, std::set<int>& seen) {
  const auto id = record.Integer("id", 1, kMaxId);
  if (!id || seen.insert(*id).second) return id;
  record.TellAt("id", fmt::format("{} is used a second time", *id),
                "give every one its own id");
  return std::nullopt;
}

Role ReadRole(const JsonRecord& record) {
  const auto role = record.Text("role");
  if (role == "structure") return Role::kStructure;
  if (role == "regular") return Role::kRegular;
  if (role == "unstructured") return Role::kUnstructured;
  if (role && *role != "other") {
    record.TellAt("role", "is " + *role + ", which is no role",
                  "use structure, regular, unstructured or other");
  }
  return Role::kOther;
}

std::optional<Eigen::Matrix3d> ReadRotation(const JsonRecord& record) {
  const auto q = record.Numbers("q_xyzw", 4);
  if (!q) return std::nullopt;
  const double length = Eigen::Vector4d((*q)[0], (*q)[1], (*q)[2], (*q)[3]).norm();
  if (std::abs(length - 1) <= kTruthUnit) {
    return RotationOf((*q)[0], (*q)[1], (*q)[2], (*q)[3]);
  }
  record.TellAt("q_xyzw", fmt::format("has length {:.8f}; expected 1", length),
                "normalise the quaternion (x y z w)");
  return std::nullopt;
}

/// Its box; one without bounds when a part of it is at fault.
void ReadObjectBox(const JsonRecord& record, TruthObject& object) {
  const auto center = record.Vector3("center");
  const auto size = record.Vector3("size");
  const auto R = ReadRotation(record);
  if (size && !(size->minCoeff() > 0)) {
    record.TellAt("size", "has a length that is not positive", "give full lengths in metres",
                  Severity::kWarning);
  }
  object.size_m.setConstant(std::numeric_limits<double>::infinity());
  if (!center || !size || !R) return;
  object.center_g = *center;
  object.size_m = *size;
  object.R_go = *R;
}

TruthObject ReadObject(const JsonRecord& record) {
  TruthObject object;
  const JsonRecord extra = record.Extra();
  object.name = extra.Text("name").value_or("");
  object.detection_group = extra.Integer("detection_group").value_or(0);
  object.object_class = record.Text("class").value_or("");
  object.role = ReadRole(record);
  object.regular = record.Flag("regular").value_or(false);
  ReadObjectBox(record, object);
  object.is_mesh = extra.Text("shape") == "mesh";
  return object;
}

std::vector<std::vector<Eigen::Vector3d>> ReadHoles(const JsonRecord& plane) {
  std::vector<std::vector<Eigen::Vector3d>> holes;
  for (const JsonRecord& hole : plane.Extra().Items("holes")) {
    holes.push_back(hole.AsPoints());
    if (holes.back().size() >= 3) continue;
    hole.Tell("has not 3 corners", "give the outline of each hole", Severity::kWarning);
    return {};
  }
  return holes;
}

/// Nothing when there is no plane to speak of.
std::optional<TruthPlane> ReadTruthPlane(const JsonRecord& record, const SceneTruth& scene) {
  TruthPlane plane;
  const auto pi_g = ReadPlane(record, kTruthUnit);
  if (pi_g) plane.pi_g = *pi_g;
  plane.object = record.Integer("object").value_or(0);
  plane.area_m2 = record.Number("area").value_or(std::nan(""));
  plane.vertices_g = record.Points("vertices");
  if (record.Contains("vertices") && plane.vertices_g.size() < 3) {
    record.TellAt("vertices", "has less than 3 corners", "give them in order");
  }
  plane.holes_g = ReadHoles(record);
  const TruthObject* object = scene.FindObject(plane.object);
  if (object == nullptr) {
    record.TellAt("object", fmt::format("is {}, which is no id of an object", plane.object),
                  "name the object that owns the plane");
  } else {
    plane.scored = object->role == Role::kStructure || object->role == Role::kRegular;
  }
  if (!pi_g) return std::nullopt;
  if (plane.vertices_g.size() >= 3) TellFaceFlaws(record, plane, object);
  return plane;
}

}  // namespace

const TruthPlane* SceneTruth::FindPlane(int id) const { return FindById(planes, id); }
const TruthObject* SceneTruth::FindObject(int id) const { return FindById(objects, id); }

SceneTruth ReadSceneTruth(Folder& folder) {
  SceneTruth scene;
  VisitJson(folder, kFile, [&](const JsonRecord& root) {
    root.Format("pas-scene-gt/1");
    std::set<int> object_ids, plane_ids;
    for (const JsonRecord& record : root.Items("objects")) {
      TruthObject object = ReadObject(record);
      object.id = ReadId(record, object_ids).value_or(0);
      if (object.id != 0) scene.objects.push_back(std::move(object));
    }
    SortById(scene.objects);
    for (const JsonRecord& record : root.Items("planes")) {
      const auto id = ReadId(record, plane_ids);
      if (!id) continue;
      if (auto plane = ReadTruthPlane(record, scene)) {
        plane->id = *id;
        scene.planes.push_back(std::move(*plane));
      }
    }
    SortById(scene.planes);
    if (std::none_of(scene.planes.begin(), scene.planes.end(),
                     [](const TruthPlane& plane) { return plane.scored; })) {
      root.TellAt("planes", "holds no plane of a structure or regular object",
                  "expect every plane of a run to count as noise", Severity::kWarning);
    }
  });
  return scene;
}

}  // namespace eval
