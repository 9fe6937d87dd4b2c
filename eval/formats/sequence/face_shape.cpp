#include "eval/formats/sequence/face_shape.h"

#include <fmt/format.h>

#include <cmath>

namespace eval {
namespace {

using Eigen::Vector3d;

// The truth is printed to round-trip; six decimals by another writer are still exact enough.
constexpr double kOnPlane_m = 1e-5;
constexpr double kInBox_m = 1e-4;     // a corner is the sum of a centre and three half lengths
constexpr double kSquare_cos = 1e-4;  // a tenth of a millimetre on a metre
constexpr double kArea_ratio = 1e-3;

void TellCornersOffPlane(const JsonRecord& record, const TruthPlane& plane) {
  for (std::size_t i = 0; i < plane.vertices_g.size(); ++i) {
    const double off_m = SignedDistance(plane.pi_g, plane.vertices_g[i]);
    if (std::abs(off_m) <= kOnPlane_m) continue;
    record.TellAt(fmt::format("vertices/{}", i),
                  fmt::format("is {:.6f} m off the plane n . x + d = 0", off_m),
                  "mend the corner, or the sign or value of d");
  }
}

/// Corners one after the other: sides square to each other, opposite sides equal.
bool IsRectangle(const std::vector<Vector3d>& v) {
  const Vector3d a = v[1] - v[0], b = v[2] - v[1];
  const double square = std::abs(a.dot(b)) / (a.norm() * b.norm());
  return square <= kSquare_cos && (v[3] - v[2] + a).norm() <= kInBox_m;
}

/// Area of a polygon as seen from the front; negative when it turns right.
double SignedArea(const std::vector<Vector3d>& corners, const Vector3d& normal) {
  Vector3d twice = Vector3d::Zero();
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    twice += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]);
  }
  return normal.dot(twice) / 2;
}

void TellWrongShape(const JsonRecord& record, const TruthPlane& plane, bool is_mesh) {
  const auto tell = [&](const char* key, std::string what, const char* mend,
                        Severity severity = Severity::kWarning) {
    record.TellAt(key, std::move(what), mend, severity);
  };
  const std::vector<Vector3d>& corners = plane.vertices_g;
  if (!is_mesh && corners.size() != 4) {
    return tell("vertices", fmt::format("has {} corners; expected 4", corners.size()),
                "give the four corners in order");
  }
  if (!is_mesh && !IsRectangle(corners)) {
    return tell("vertices", "is no rectangle", "give the corners in order around the face");
  }
  const double outline_m2 = SignedArea(corners, plane.pi_g.n);
  if (is_mesh && !(outline_m2 > 0)) {
    return tell("vertices", "turns right as seen from the front",
                "give the outline counter-clockwise about the normal");
  }
  double area_m2 = std::abs(outline_m2);
  for (const auto& hole : plane.holes_g) area_m2 -= std::abs(SignedArea(hole, plane.pi_g.n));
  if (std::abs(plane.area_m2 - area_m2) > kArea_ratio * area_m2) {
    tell("area",
         fmt::format("is {} m^2, but the corners enclose {:.6f} m^2", plane.area_m2, area_m2),
         "give the area of the whole face", Severity::kFlaw);
  }
}

void TellOutsideObject(const JsonRecord& record, const TruthPlane& plane,
                       const TruthObject& object) {
  if (!object.size_m.allFinite()) return;  // at fault, which has been told
  const std::vector<Vector3d>& corners = plane.vertices_g;
  const Vector3d middle_g = (corners[0] + corners[2]) / 2;
  if (!object.is_mesh && !(plane.pi_g.n.dot(middle_g - object.center_g) > 0)) {
    record.TellAt("normal", "points into the object", "turn the normal and d around");
  }
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3d x_o = object.R_go.transpose() * (corners[i] - object.center_g);
    if (((x_o.cwiseAbs() - object.size_m / 2).array() <= kInBox_m).all()) continue;
    record.TellAt(fmt::format("vertices/{}", i), "is outside the box of the object",
                  "mend the corner, or the object's center, size (full lengths) or q_xyzw",
                  Severity::kWarning);
    return;
  }
}

}  // namespace

void TellFaceFlaws(const JsonRecord& record, const TruthPlane& plane,
                   const TruthObject* object) {
  TellCornersOffPlane(record, plane);
  TellWrongShape(record, plane, object != nullptr && object->is_mesh);
  if (object != nullptr) TellOutsideObject(record, plane, *object);
}

}  // namespace eval
