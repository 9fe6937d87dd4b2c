#include "sim/shapes/planes.h"

#include "sim/scene/geometry.h"
#include "sim/shapes/faces.h"

namespace sim {
namespace {

void AddBoxPlanes(const Object& object, std::vector<ScenePlane>& planes) {
  for (const Face face : kFaces) {
    const FaceRectangle rectangle = RectangleOf(object, face);
    ScenePlane plane;
    plane.face = face;
    plane.n_w = rectangle.n_w;
    plane.d = -rectangle.n_w.dot(rectangle.center_w);
    plane.area_m2 = rectangle.size_m.x() * rectangle.size_m.y();
    plane.vertices_w.assign(rectangle.corners_w.begin(), rectangle.corners_w.end());
    planes.push_back(plane);
  }
}

void AddModelPlanes(const Object& object, std::vector<ScenePlane>& planes) {
  const Model& model = *object.model;
  const Pose T_wo = ObjectPose(object);
  const auto moved = [&](std::vector<Eigen::Vector3d> points) {
    for (Eigen::Vector3d& x : points) x = T_wo * x;
    return points;
  };
  const std::size_t first = planes.size();
  for (const ModelPlane& own : model.planes) {
    ScenePlane plane;
    plane.n_w = T_wo.R * own.n_o;
    plane.d = own.d - plane.n_w.dot(T_wo.t);
    plane.area_m2 = own.area_m2;
    plane.vertices_w = moved(own.outline_o);
    for (const auto& hole : own.holes_o) plane.holes_w.push_back(moved(hole));
    planes.push_back(std::move(plane));
  }
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.plane_of[t] < 0) continue;
    std::vector<Eigen::Vector3d> corners;
    for (const int i : model.triangles[t]) {
      corners.push_back(model.vertices_o[static_cast<std::size_t>(i)]);
    }
    planes[first + static_cast<std::size_t>(model.plane_of[t])].pieces_w.push_back(
        moved(corners));
  }
}

}  // namespace

std::vector<ScenePlane> ScenePlanes(const Scene& scene) {
  std::vector<ScenePlane> planes;
  for (const Object& object : scene.objects) {
    const std::size_t first = planes.size();
    if (!object.way.empty()) continue;  // what moves has no plane that stays
    if (object.shape == ShapeKind::kBox) AddBoxPlanes(object, planes);
    if (object.shape == ShapeKind::kMesh) AddModelPlanes(object, planes);
    for (std::size_t i = first; i < planes.size(); ++i) {
      planes[i].id = static_cast<int>(i) + 1;
      planes[i].object = object.id;
    }
  }
  return planes;
}

std::vector<std::vector<Eigen::Vector3d>> ConvexPieces(const ScenePlane& plane) {
  if (plane.pieces_w.empty()) return {plane.vertices_w};
  return plane.pieces_w;
}

}  // namespace sim
