#include "sim/shapes/mesh.h"

#include <Eigen/Geometry>
#include <map>

#include "sim/scene/geometry.h"
#include "sim/shapes/body.h"
#include "sim/shapes/faces.h"
#include "sim/shapes/round.h"
#include "sim/shapes/toy.h"

namespace sim {
namespace {

void AddBox(const Object& object, int& plane_id, SceneMesh& mesh) {
  for (const Face face : kFaces) {
    const FaceRectangle rectangle = RectangleOf(object, face);
    const double U = rectangle.size_m.x(), V = rectangle.size_m.y();
    const std::array<Eigen::Vector2d, 4> uv{{{0.0, 0.0}, {U, 0.0}, {U, V}, {0.0, V}}};
    Triangle triangle;
    triangle.normals_w.fill(rectangle.n_w);
    triangle.object = object.id;
    triangle.plane = ++plane_id;
    triangle.material = static_cast<int>(mesh.materials.size());
    mesh.materials.push_back(object.faces[static_cast<std::size_t>(face)]);
    for (const auto& [i, j, k] : {std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}}) {
      const auto& corners = rectangle.corners_w;
      triangle.corners_w = {corners[i], corners[j], corners[k]};
      triangle.uv_m = {uv[i], uv[j], uv[k]};
      mesh.triangles.push_back(triangle);
    }
  }
}

/// Position on the side of the bounding cube that the triangle faces most.
Eigen::Vector2d CubeMap(const Eigen::Vector3d& n_o, const Eigen::Vector3d& x_o) {
  Eigen::Index axis = 0;
  n_o.cwiseAbs().maxCoeff(&axis);
  return {x_o[(axis + 1) % 3], x_o[(axis + 2) % 3]};
}

ClosedSurface BodyOf(const Object& object) {
  if (object.shape == ShapeKind::kToy) return ToySurface(object.size, object.seed);
  if (object.shape == ShapeKind::kPerson) return PersonSurface(object.size);
  if (object.shape == ShapeKind::kHand) return HandSurface(object.size);
  if (object.shape == ShapeKind::kBush) return BushSurface(object.size, object.seed);
  return RoundSurface(object.shape, object.size);
}

/// Sums of the faces round each vertex, but for those that stand off by more than the crease:
/// a rim stays sharp.
Eigen::Vector3d Smoothed(const std::vector<Eigen::Vector3d>& round_vertex,
                         const Eigen::Vector3d& own) {
  constexpr double kCrease = 0.7;  // cosine
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& n : round_vertex) {
    if (n.dot(own) > kCrease * n.norm() * own.norm()) sum += n;
  }
  return sum.normalized();
}

/// Normal of a triangle, as long as twice its area.
Eigen::Vector3d FaceNormal(const std::vector<Eigen::Vector3d>& vertices,
                           const std::array<int, 3>& t) {
  const auto corner = [&](int i) { return vertices[static_cast<std::size_t>(i)]; };
  return (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]));
}

void AddBody(const Object& object, SceneMesh& mesh) {
  const ClosedSurface body = BodyOf(object);
  const Pose T_wo = ObjectPose(object);
  const auto corner = [&](int i) { return body.vertices_o[static_cast<std::size_t>(i)]; };
  const auto face_normal = [&](const auto& t) { return FaceNormal(body.vertices_o, t); };
  const bool creased = object.shape != ShapeKind::kToy;
  std::vector<Eigen::Vector3d> normals_o(body.vertices_o.size(), Eigen::Vector3d::Zero());
  std::vector<std::vector<Eigen::Vector3d>> faces_o(body.vertices_o.size());
  for (const auto& t : body.triangles) {
    for (const int i : t) {
      normals_o[static_cast<std::size_t>(i)] += face_normal(t);
      if (creased) faces_o[static_cast<std::size_t>(i)].push_back(face_normal(t));
    }
  }
  const int material = static_cast<int>(mesh.materials.size());
  mesh.materials.push_back(object.faces[0]);
  for (const auto& t : body.triangles) {
    Triangle triangle;
    triangle.object = object.id;
    triangle.material = material;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(t[i]);
      triangle.corners_w[i] = T_wo * corner(t[i]);
      triangle.uv_m[i] = CubeMap(face_normal(t), corner(t[i]));
      triangle.normals_w[i] = T_wo.R * (creased ? Smoothed(faces_o[at], face_normal(t))
                                                : normals_o[at].normalized());
    }
    mesh.triangles.push_back(triangle);
  }
}

/// Two axes that make with the normal a right-handed frame, level where the plane allows.
std::pair<Eigen::Vector3d, Eigen::Vector3d> AxesIn(const Eigen::Vector3d& n) {
  const Eigen::Vector3d level = Eigen::Vector3d::UnitZ().cross(n);
  const Eigen::Vector3d u =
      level.norm() > 0.1 ? level.normalized() : Eigen::Vector3d::UnitY().cross(n).normalized();
  return {u, n.cross(u)};
}

/// Materials of a mesh: one a plane and colour, so that a print fits the plane it is on.
class ModelMaterials {
 public:
  ModelMaterials(const Object& object, SceneMesh& mesh) : object_(object), mesh_(mesh) {}
  int Of(int plane, int colour) {
    const int own = object_.model_colours ? colour : 0;
    const auto [at, fresh] =
        known_.try_emplace({plane, own}, static_cast<int>(mesh_.materials.size()));
    if (fresh) {
      Material material = object_.faces[0];
      if (object_.model_colours) {
        material = {};
        material.richness = 0;
        material.colour = object_.model->colours.at(static_cast<std::size_t>(colour));
      }
      mesh_.materials.push_back(material);
    }
    return at->second;
  }

 private:
  const Object& object_;
  SceneMesh& mesh_;
  std::map<std::pair<int, int>, int> known_;
};

void AddModel(const Object& object, int& plane_id, SceneMesh& mesh) {
  const Model& model = *object.model;
  const Pose T_wo = ObjectPose(object);
  const auto corner = [&](int i) { return model.vertices_o[static_cast<std::size_t>(i)]; };
  const auto face_normal = [&](const auto& t) { return FaceNormal(model.vertices_o, t); };
  std::vector<std::vector<Eigen::Vector3d>> faces_o(model.vertices_o.size());
  for (const auto& t : model.triangles) {
    for (const int i : t) faces_o[static_cast<std::size_t>(i)].push_back(face_normal(t));
  }
  ModelMaterials materials(object, mesh);
  for (std::size_t k = 0; k < model.triangles.size(); ++k) {
    const auto& t = model.triangles[k];
    const int plane = model.plane_of[k];
    const Eigen::Vector3d n_o =
        plane < 0 ? face_normal(t) : model.planes[static_cast<std::size_t>(plane)].n_o;
    Triangle triangle;
    triangle.object = object.id;
    triangle.plane = plane < 0 ? 0 : plane_id + plane + 1;
    triangle.material = materials.Of(plane, model.colour_of[k]);
    for (std::size_t i = 0; i < 3; ++i) {
      const Eigen::Vector3d x_o = corner(t[i]);
      triangle.corners_w[i] = T_wo * x_o;
      if (plane < 0) {
        triangle.uv_m[i] = CubeMap(n_o, x_o);
        triangle.normals_w[i] = T_wo.R * Smoothed(faces_o[static_cast<std::size_t>(t[i])], n_o);
      } else {
        const auto [u, v] = AxesIn(n_o);
        triangle.uv_m[i] = {u.dot(x_o), v.dot(x_o)};
        triangle.normals_w[i] = T_wo.R * n_o;
      }
    }
    mesh.triangles.push_back(triangle);
  }
  plane_id += static_cast<int>(model.planes.size());
}

}  // namespace

SceneMesh BuildMesh(const Scene& scene) {
  SceneMesh mesh;
  mesh.planes = ScenePlanes(scene);
  int plane_id = 0;  // counts as ScenePlanes does
  for (const Object& given : scene.objects) {
    const bool moves = !given.way.empty();
    const Object object = moves ? ObjectAt(given, given.way.front().time_s) : given;
    const int planes_before = plane_id;
    const std::size_t first = mesh.triangles.size();
    if (object.shape == ShapeKind::kBox) {
      AddBox(object, plane_id, mesh);
    } else if (object.shape == ShapeKind::kMesh) {
      AddModel(object, plane_id, mesh);
    } else {
      AddBody(object, mesh);
    }
    if (!moves) continue;
    plane_id = planes_before;
    for (std::size_t i = first; i < mesh.triangles.size(); ++i) mesh.triangles[i].plane = 0;
  }
  return mesh;
}

}  // namespace sim
