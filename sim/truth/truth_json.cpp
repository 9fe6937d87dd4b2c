#include "sim/truth/truth_json.h"

#include <nlohmann/json.hpp>

#include "sim/scene/names.h"
#include "sim/truth/plane_pairs.h"

namespace sim {
namespace {

using Json = nlohmann::ordered_json;

Json Vector(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }
Json Box(const PixelBox& box) { return {box.x0, box.y0, box.x1, box.y1}; }

/// What moves is told as it stands at the first point of its way.
Json ObjectJson(const Object& given) {
  const Object object = given.way.empty() ? given : ObjectAt(given, given.way.front().time_s);
  const Eigen::Quaterniond& q = object.q_wo;
  Json json;
  json["id"] = object.id;
  json["name"] = object.name;
  json["class"] = object.class_name;
  json["role"] = kRoleNames[static_cast<std::size_t>(object.role)];
  json["regular"] = object.role == Role::kRegular;
  json["center"] = Vector(object.center_w);
  json["size"] = Vector(object.size);
  json["q_xyzw"] = {q.x(), q.y(), q.z(), q.w()};
  if (object.shape == ShapeKind::kMesh) json["shape"] = "mesh";
  if (object.detection_group > 0) json["detection_group"] = object.detection_group;
  return json;
}

Json PlaneJson(const ScenePlane& plane) {
  Json json;
  json["id"] = plane.id;
  json["object"] = plane.object;
  json["normal"] = Vector(plane.n_w);
  json["d"] = plane.d;
  json["area"] = plane.area_m2;
  json["vertices"] = Json::array();
  for (const Eigen::Vector3d& vertex : plane.vertices_w)
    json["vertices"].push_back(Vector(vertex));
  for (const auto& hole : plane.holes_w) {
    Json points = Json::array();
    for (const Eigen::Vector3d& x_w : hole) points.push_back(Vector(x_w));
    json["holes"].push_back(std::move(points));
  }
  return json;
}

const char* StateName(VertexState state) {
  switch (state) {
    case VertexState::kVisible:
      return "visible";
    case VertexState::kOccluded:
      return "occluded";
    case VertexState::kOutside:
      break;
  }
  return "outside";
}

Json PlaneInFrameJson(const PlaneInFrame& plane) {
  Json json{{"id", plane.id}, {"pixels", plane.pixels}};
  json["outline"] = Json::array();
  for (const Eigen::Vector2d& p : plane.outline) json["outline"].push_back({p.x(), p.y()});
  json["vertices"] = Json::array();
  for (const VertexInFrame& vertex : plane.vertices) {
    Json entry{{"world", Vector(vertex.x_w)}};
    if (vertex.projects) {
      entry["pixel"] = {vertex.pixel.x(), vertex.pixel.y()};
    } else {
      entry["pixel"] = nullptr;
    }
    entry["state"] = StateName(vertex.state);
    if (vertex.state == VertexState::kVisible) entry["at_edge"] = vertex.surface_ends;
    json["vertices"].push_back(std::move(entry));
  }
  return json;
}

}  // namespace

std::string SceneTruthJson(const Scene& scene, const std::vector<ScenePlane>& planes) {
  Json json;
  json["format"] = "pas-scene-gt/1";
  json["name"] = scene.name;
  json["objects"] = Json::array();
  for (const Object& object : scene.objects) json["objects"].push_back(ObjectJson(object));
  json["planes"] = Json::array();
  for (const ScenePlane& plane : planes) json["planes"].push_back(PlaneJson(plane));
  json["pairs"] = Json::array();
  for (const PlanePair& pair : PlanePairs(scene, planes)) {
    json["pairs"].push_back({{"a", pair.a},
                             {"b", pair.b},
                             {"angle_deg", pair.angle_deg},
                             {"lateral_gap_mm", pair.lateral_gap_mm},
                             {"step_mm", pair.step_mm},
                             {"step_sigmas", pair.step_sigmas}});
  }
  return json.dump(1) + "\n";
}

std::string FrameTruthJson(double timestamp_s, const FrameTruth& truth) {
  Json json;
  json["timestamp"] = timestamp_s;
  json["objects"] = Json::array();
  for (const ObjectInFrame& object : truth.objects) {
    json["objects"].push_back({{"id", object.id},
                               {"pixels", object.pixels},
                               {"visible_box", Box(object.visible_box)},
                               {"amodal_box", Box(object.amodal_box)},
                               {"visible_fraction", object.visible_fraction}});
    if (!object.T_wo) continue;
    const Eigen::Quaterniond q(object.T_wo->R);
    json["objects"].back()["center"] = Vector(object.T_wo->t);
    json["objects"].back()["q_xyzw"] = {q.x(), q.y(), q.z(), q.w()};
  }
  json["planes"] = Json::array();
  for (const PlaneInFrame& plane : truth.planes) {
    json["planes"].push_back(PlaneInFrameJson(plane));
  }
  return json.dump();
}

}  // namespace sim
