#include "eval/read/scene_truth.h"

#include <algorithm>
#include <cmath>

#include "io/input_error.h"
#include "io/json_field.h"

namespace eval {
namespace {

constexpr double kUnitTolerance = 1e-6;

Role ReadRole(const io::JsonField& field) {
  const std::string text = field.Text();
  if (text == "structure") return Role::kStructure;
  if (text == "regular") return Role::kRegular;
  if (text == "unstructured") return Role::kUnstructured;
  if (text == "other") return Role::kOther;
  field.Fail("structure, regular, unstructured or other");
}

TruthObject ReadObject(const io::JsonField& field) {
  TruthObject object;
  object.id = field["id"].Integer();
  if (const auto name = field.Find("name")) object.name = name->Text();
  if (const auto group = field.Find("detection_group")) {
    object.detection_group = group->Integer();
  }
  object.object_class = field["class"].Text();
  object.role = ReadRole(field["role"]);
  object.regular = field["regular"].Boolean();
  object.center_g = field["center"].Vector3();
  object.size_m = field["size"].Vector3();
  const std::vector<double> q = field["q_xyzw"].Numbers();
  const auto is_unit = [&] {
    const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    return std::abs(norm - 1.0) <= kUnitTolerance;
  };
  if (q.size() != 4 || !is_unit()) field["q_xyzw"].Fail("a unit quaternion [x, y, z, w]");
  object.R_go = RotationOf(q[0], q[1], q[2], q[3]);
  return object;
}

TruthPlane ReadPlane(const io::JsonField& field) {
  TruthPlane plane;
  plane.id = field["id"].Integer();
  if (plane.id <= 0 || plane.id > 65535) {
    field["id"].Fail("a plane id from 1 to 65535 (16-bit images, 0 means none)");
  }
  plane.object = field["object"].Integer();
  plane.pi_g.n = field["normal"].Vector3();
  if (!(std::abs(plane.pi_g.n.norm() - 1.0) <= kUnitTolerance)) {
    field["normal"].Fail("a unit normal");
  }
  plane.pi_g.n.normalize();
  plane.pi_g.d = field["d"].Number();
  plane.area_m2 = field["area"].Number();
  plane.vertices_g = field["vertices"].Points();
  if (plane.vertices_g.size() < 3) field["vertices"].Fail("at least 3 vertices in order");
  return plane;
}

template <typename Entry>
const Entry* FindById(const std::vector<Entry>& entries, int id) {
  const auto found = std::lower_bound(entries.begin(), entries.end(), id,
                                      [](const Entry& e, int i) { return e.id < i; });
  return found != entries.end() && found->id == id ? &*found : nullptr;
}

template <typename Entry>
void SortById(std::vector<Entry>& entries, const std::filesystem::path& file,
              const char* what) {
  std::sort(entries.begin(), entries.end(),
            [](const Entry& a, const Entry& b) { return a.id < b.id; });
  const auto twice =
      std::adjacent_find(entries.begin(), entries.end(),
                         [](const Entry& a, const Entry& b) { return a.id == b.id; });
  if (twice != entries.end()) {
    throw io::InputError(file.string(), std::string(what) + " id " + std::to_string(twice->id) +
                                            " stands twice; ids must differ");
  }
}

std::optional<std::array<double, 4>> ReadBox(const std::optional<io::JsonField>& field) {
  if (!field) return std::nullopt;
  const std::vector<double> box = field->Numbers();
  if (box.size() != 4) field->Fail("4 numbers [x0, y0, x1, y1]");
  return std::array<double, 4>{box[0], box[1], box[2], box[3]};
}

}  // namespace

const TruthPlane* SceneTruth::FindPlane(int id) const { return FindById(planes, id); }
const TruthObject* SceneTruth::FindObject(int id) const { return FindById(objects, id); }

SceneTruth ReadSceneTruth(const std::filesystem::path& file) {
  const nlohmann::json json = io::ReadJson(file);
  const io::JsonField root(json, file.string());
  if (root["format"].Text() != "pas-scene-gt/1") root["format"].Fail("\"pas-scene-gt/1\"");
  SceneTruth scene;
  for (const io::JsonField& field : root["objects"].Elements()) {
    scene.objects.push_back(ReadObject(field));
  }
  SortById(scene.objects, file, "object");
  for (const io::JsonField& field : root["planes"].Elements()) {
    TruthPlane plane = ReadPlane(field);
    const TruthObject* object = scene.FindObject(plane.object);
    if (object == nullptr) field["object"].Fail("the id of an object of this scene");
    plane.scored = object->role == Role::kStructure || object->role == Role::kRegular;
    scene.planes.push_back(std::move(plane));
  }
  SortById(scene.planes, file, "plane");
  return scene;
}

std::vector<FrameTruth> ReadFrameTruth(const std::filesystem::path& file) {
  std::vector<FrameTruth> frames;
  io::ForEachJsonLine(file, "", [&](const io::JsonField& root) {
    FrameTruth frame;
    frame.stamp_s = root["timestamp"].Number();
    for (const io::JsonField& field : root["objects"].Elements()) {
      VisibleObject object;
      object.id = field["id"].Integer();
      object.pixels = field["pixels"].Integer();
      object.visible_box_px = ReadBox(field.Find("visible_box"));
      object.amodal_box_px = ReadBox(field.Find("amodal_box"));
      if (const auto fraction = field.Find("visible_fraction")) {
        object.visible_fraction = fraction->Number();
      }
      frame.objects.push_back(object);
    }
    for (const io::JsonField& field : root["planes"].Elements()) {
      frame.planes.push_back({field["id"].Integer(), field["pixels"].Integer()});
    }
    frames.push_back(std::move(frame));
  });
  std::stable_sort(frames.begin(), frames.end(), [](const FrameTruth& a, const FrameTruth& b) {
    return a.stamp_s < b.stamp_s;
  });
  return frames;
}

}  // namespace eval
