#include "eval/check/check_scene_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "eval/check/checked_json.h"

namespace eval {
namespace {

using Eigen::Vector3d;

const std::string kFile = "gt/scene.json";
// The truth is printed to round-trip; six decimals by another writer are still exact enough.
constexpr double kUnit = 1e-6;
constexpr double kOnPlane_m = 1e-5;
constexpr double kSquare_cos = 1e-4;
constexpr double kRelativeArea = 1e-3;

struct Box {
  Vector3d center, size;
  Eigen::Quaterniond q_wo;
};

Vector3d AsVector(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

void CheckRole(const CheckedJson& object) {
  constexpr std::array<const char*, 4> kRoles{"structure", "regular", "unstructured", "other"};
  const auto role = object.Text("role");
  if (!role || std::find(kRoles.begin(), kRoles.end(), *role) != kRoles.end()) return;
  object.ReportAt("role", "is " + *role + ", which is no role",
                  "use structure, regular, unstructured or other");
}

std::optional<Box> CheckObject(const CheckedJson& object) {
  object.Text("class");
  CheckRole(object);
  object.Flag("regular");
  const auto center = object.Numbers("center", 3);
  const auto size = object.Numbers("size", 3);
  const auto q = object.Numbers("q_xyzw", 4);
  if (size && !(AsVector(*size).minCoeff() > 0)) {
    object.ReportAt("size", "has a length that is not positive", "give full lengths in metres");
  }
  if (!center || !size || !q) return std::nullopt;
  const Eigen::Quaterniond q_wo((*q)[3], (*q)[0], (*q)[1], (*q)[2]);
  if (!(std::abs(q_wo.norm() - 1) <= kUnit)) {
    object.ReportAt("q_xyzw", fmt::format("has length {:.8f}; expected 1", q_wo.norm()),
                    "normalise the quaternion (x y z w)");
    return std::nullopt;
  }
  return Box{AsVector(*center), AsVector(*size), q_wo.normalized()};
}

// Corners one after the other: sides square to each other, opposite sides equal.
bool IsRectangle(const std::array<Vector3d, 4>& v) {
  const Vector3d a = v[1] - v[0], b = v[2] - v[1];
  const double square = std::abs(a.dot(b)) / (a.norm() * b.norm());
  return square <= kSquare_cos && (v[3] - v[2] + a).norm() <= kOnPlane_m * 10;
}

std::optional<std::array<Vector3d, 4>> Corners(const CheckedJson& plane) {
  const std::vector<CheckedJson> items = plane.Items("vertices");
  std::array<Vector3d, 4> corners;
  if (items.size() != 4) {
    if (plane.Has("vertices")) {
      plane.ReportAt("vertices", fmt::format("has {} corners; expected 4", items.size()),
                     "give the four corners in order");
    }
    return std::nullopt;
  }
  bool good = true;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto numbers = items[i].AsNumbers(3);
    good = good && numbers.has_value();
    if (numbers) corners[i] = AsVector(*numbers);
  }
  if (!good) return std::nullopt;
  return corners;
}

void CheckCornersOnPlane(const CheckedJson& plane, const std::array<Vector3d, 4>& corners,
                         const CheckedScene::Plane& pi) {
  for (std::size_t i = 0; i < 4; ++i) {
    const double off = pi.normal.dot(corners[i]) + pi.d;
    if (std::abs(off) <= kOnPlane_m) continue;
    plane.ReportAt(fmt::format("vertices/{}", i),
                   fmt::format("is {:.6f} m off the plane n . x + d = 0", off),
                   "mend the corner, or the sign or value of d");
  }
}

void CheckShape(const CheckedJson& plane, const std::array<Vector3d, 4>& corners) {
  if (!IsRectangle(corners)) {
    plane.ReportAt("vertices", "is no rectangle", "give the corners in order around the face");
    return;
  }
  const double area = (corners[1] - corners[0]).cross(corners[2] - corners[1]).norm();
  const auto told = plane.Number("area");
  if (told && !(std::abs(*told - area) <= kRelativeArea * area)) {
    plane.ReportAt("area",
                   fmt::format("is {} m^2, but the corners enclose {:.6f} m^2", *told, area),
                   "give the area of the whole face");
  }
}

void CheckAgainstObject(const CheckedJson& plane, const std::array<Vector3d, 4>& corners,
                        const Vector3d& normal, const Box& box) {
  const Vector3d middle = (corners[0] + corners[2]) / 2;
  if (!(normal.dot(middle - box.center) > 0)) {
    plane.ReportAt("normal", "points into the object", "turn the normal and d around");
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d x_o = box.q_wo.conjugate() * (corners[i] - box.center);
    if (((x_o.cwiseAbs() - box.size / 2).array() <= kOnPlane_m * 10).all()) continue;
    plane.ReportAt(fmt::format("vertices/{}", i), "is outside the box of the object",
                   "mend the corner, or the object's center, size (full lengths) or q_xyzw");
    return;
  }
}

void CheckPlane(const CheckedJson& plane, int id, const std::map<int, Box>& boxes,
                CheckedScene& scene) {
  const auto normal = plane.Numbers("normal", 3);
  const auto d = plane.Number("d");
  const auto object = plane.Integer("object");
  const auto corners = Corners(plane);
  if (!normal || !d) return;
  CheckedScene::Plane pi{AsVector(*normal), *d, object ? static_cast<int>(*object) : 0, {}};
  if (corners) pi.corners.assign(corners->begin(), corners->end());
  if (!(std::abs(pi.normal.norm() - 1) <= kUnit)) {
    plane.ReportAt("normal", fmt::format("has length {:.8f}; expected 1", pi.normal.norm()),
                   "normalise the normal and divide d by the same length");
    return;
  }
  if (corners) {
    CheckCornersOnPlane(plane, *corners, pi);
    CheckShape(plane, *corners);
  }
  if (object && scene.objects.count(pi.object) == 0) {
    plane.ReportAt("object", fmt::format("is {}, which is no id of an object", *object),
                   "name the object that owns the plane");
  } else if (corners && boxes.count(pi.object) != 0) {
    CheckAgainstObject(plane, *corners, pi.normal, boxes.at(pi.object));
  }
  scene.planes[id] = pi;
}

// The ids of a list: whole, from 1 to 65535 (0 means "none" in a 16-bit image), each once.
std::optional<int> CheckId(const CheckedJson& record, std::set<int>& seen) {
  const auto id = record.Integer("id");
  if (!id) return std::nullopt;
  if (*id < 1 || *id > 65535) {
    record.ReportAt("id", fmt::format("is {}; expected 1 to 65535", *id),
                    "number from 1; 0 means none in the id images");
    return std::nullopt;
  }
  if (seen.insert(static_cast<int>(*id)).second) return static_cast<int>(*id);
  record.ReportAt("id", fmt::format("{} is used a second time", *id),
                  "give every one its own id");
  return std::nullopt;
}

}  // namespace

std::optional<CheckedScene> CheckSceneTruth(FolderCheck& check) {
  if (!check.Has(kFile)) return std::nullopt;
  CheckedScene scene;
  VisitJson(check, kFile, [&](const CheckedJson& root) {
    const auto format = root.Text("format");
    if (format && *format != "pas-scene-gt/1") {
      root.ReportAt("format", "is " + *format + "; expected pas-scene-gt/1",
                    "convert the file to this version of the format");
    }
    std::map<int, Box> boxes;
    std::set<int> object_ids, plane_ids;
    for (const CheckedJson& object : root.Items("objects")) {
      const auto id = CheckId(object, object_ids);
      const auto box = CheckObject(object);
      if (!id) continue;
      scene.objects[*id] = box ? box->center : Vector3d::Zero();
      if (box) boxes.emplace(*id, *box);
    }
    for (const CheckedJson& plane : root.Items("planes")) {
      if (const auto id = CheckId(plane, plane_ids)) CheckPlane(plane, *id, boxes, scene);
    }
  });
  return scene;
}

}  // namespace eval
