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
  bool of_mesh =
      false;  ///< its planes are any polygons, and need not face away from its middle
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
  const bool of_mesh = object.Has("shape") && object.Text("shape") == "mesh";
  return Box{AsVector(*center), AsVector(*size), q_wo.normalized(), of_mesh};
}

// Corners one after the other: sides square to each other, opposite sides equal.
bool IsRectangle(const std::vector<Vector3d>& v) {
  if (v.size() != 4) return false;
  const Vector3d a = v[1] - v[0], b = v[2] - v[1];
  const double square = std::abs(a.dot(b)) / (a.norm() * b.norm());
  return square <= kSquare_cos && (v[3] - v[2] + a).norm() <= kOnPlane_m * 10;
}

/// Of one loop; nothing when it is at fault.
std::vector<Vector3d> Points(const std::vector<CheckedJson>& items) {
  std::vector<Vector3d> points;
  for (const CheckedJson& item : items) {
    const auto numbers = item.AsNumbers(3);
    if (!numbers) return {};
    points.push_back(AsVector(*numbers));
  }
  return points;
}

/// Four of a box; three or more of a mesh.
std::vector<Vector3d> Corners(const CheckedJson& plane, bool of_mesh) {
  const std::vector<CheckedJson> items = plane.Items("vertices");
  if (of_mesh ? items.size() >= 3 : items.size() == 4) return Points(items);
  if (plane.Has("vertices")) {
    plane.ReportAt(
        "vertices",
        fmt::format("has {} corners; expected {}", items.size(), of_mesh ? "3 or more" : "4"),
        of_mesh ? "give the outline in order" : "give the four corners in order");
  }
  return {};
}

std::vector<std::vector<Vector3d>> Holes(const CheckedJson& plane) {
  std::vector<std::vector<Vector3d>> holes;
  if (!plane.Has("holes")) return holes;
  for (const CheckedJson& hole : plane.Items("holes")) {
    holes.push_back(Points(hole.AsItems()));
    if (holes.back().size() >= 3) continue;
    plane.ReportAt("holes", "has one without 3 corners", "give the outline of each hole");
    return {};
  }
  return holes;
}

void CheckCornersOnPlane(const CheckedJson& plane, const std::vector<Vector3d>& corners,
                         const CheckedScene::Plane& pi) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double off = pi.normal.dot(corners[i]) + pi.d;
    if (std::abs(off) <= kOnPlane_m) continue;
    plane.ReportAt(fmt::format("vertices/{}", i),
                   fmt::format("is {:.6f} m off the plane n . x + d = 0", off),
                   "mend the corner, or the sign or value of d");
  }
}

/// Of a polygon, seen from the front; negative when it turns right.
double SignedArea(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  Vector3d twice = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  return normal.dot(twice) / 2;
}

void CheckShape(const CheckedJson& plane, const CheckedScene::Plane& pi, bool of_mesh) {
  if (!of_mesh && !IsRectangle(pi.corners)) {
    plane.ReportAt("vertices", "is no rectangle", "give the corners in order around the face");
    return;
  }
  double area = SignedArea(pi.corners, pi.normal);
  if (of_mesh && !(area > 0)) {
    plane.ReportAt("vertices", "turns right as seen from the front",
                   "give the outline counter-clockwise about the normal");
    return;
  }
  area = std::abs(area);
  for (const auto& hole : pi.holes) area -= std::abs(SignedArea(hole, pi.normal));
  const auto told = plane.Number("area");
  if (told && !(std::abs(*told - area) <= kRelativeArea * area)) {
    plane.ReportAt("area",
                   fmt::format("is {} m^2, but the corners enclose {:.6f} m^2", *told, area),
                   "give the area of the whole face");
  }
}

void CheckAgainstObject(const CheckedJson& plane, const std::vector<Vector3d>& corners,
                        const Vector3d& normal, const Box& box) {
  const Vector3d middle = (corners[0] + corners[2]) / 2;
  if (!box.of_mesh && !(normal.dot(middle - box.center) > 0)) {
    plane.ReportAt("normal", "points into the object", "turn the normal and d around");
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
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
  const auto box = boxes.find(object ? static_cast<int>(*object) : 0);
  const bool of_mesh = box != boxes.end() && box->second.of_mesh;
  const std::vector<Vector3d> corners = Corners(plane, of_mesh);
  if (!normal || !d) return;
  CheckedScene::Plane pi{AsVector(*normal), *d, object ? static_cast<int>(*object) : 0, corners,
                         Holes(plane)};
  if (!(std::abs(pi.normal.norm() - 1) <= kUnit)) {
    plane.ReportAt("normal", fmt::format("has length {:.8f}; expected 1", pi.normal.norm()),
                   "normalise the normal and divide d by the same length");
    return;
  }
  if (!corners.empty()) {
    CheckCornersOnPlane(plane, corners, pi);
    CheckShape(plane, pi, of_mesh);
  }
  if (object && scene.objects.count(pi.object) == 0) {
    plane.ReportAt("object", fmt::format("is {}, which is no id of an object", *object),
                   "name the object that owns the plane");
  } else if (!corners.empty() && box != boxes.end()) {
    CheckAgainstObject(plane, corners, pi.normal, box->second);
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
