#include "sim/shapes/mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <utility>

#include "sim/families/families.h"
#include "sim/shapes/faces.h"
#include "sim/shapes/planes.h"
#include "sim/shapes/toy.h"
#include "tests/support/place.h"

namespace sim {
namespace {

// Coordinates stay below 6 m and each check is under 50 flops: 50 * 6 * 2^-53 < 4e-14.
constexpr double kVolumeRoundOff_m = 1e-12;

double SignedVolume(const Triangle& t) {
  return t.corners_w[0].dot(t.corners_w[1].cross(t.corners_w[2])) / 6;
}

std::map<int, std::vector<Triangle>> ByObject(const SceneMesh& mesh) {
  std::map<int, std::vector<Triangle>> objects;
  for (const Triangle& triangle : mesh.triangles) objects[triangle.object].push_back(triangle);
  return objects;
}

TEST(BuildMesh, ClosesEveryBody) {
  const Scene scene = MakeScene("desk", 3);
  for (const auto& [id, triangles] : ByObject(BuildMesh(scene))) {
    std::map<std::pair<Place, Place>, int> edges;
    double volume = 0;
    for (const Triangle& t : triangles) {
      volume += SignedVolume(t);
      for (std::size_t i = 0; i < 3; ++i) {
        ++edges[{Nanometres(t.corners_w[i]), Nanometres(t.corners_w[(i + 1) % 3])}];
      }
    }
    EXPECT_GT(volume, 0) << "object " << id << " is inside out";
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1) << "object " << id;
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "object " << id << " has a hole";
    }
  }
}

TEST(BuildMesh, GivesBoxesTheirVolume) {
  const Scene scene = MakeScene("plates", 2);
  const auto objects = ByObject(BuildMesh(scene));
  for (const Object& object : scene.objects) {
    double volume = 0;
    for (const Triangle& t : objects.at(object.id)) volume += SignedVolume(t);
    EXPECT_NEAR(volume, object.size.prod(), 1e-9);
  }
}

TEST(BuildMesh, PutsEveryCornerOnThePlaneOfItsId) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Scene scene = MakeScene("desk", seed);
    const std::vector<ScenePlane> planes = ScenePlanes(scene);
    for (const Triangle& t : BuildMesh(scene).triangles) {
      if (t.plane == 0) continue;
      const ScenePlane& plane = planes.at(static_cast<std::size_t>(t.plane - 1));
      ASSERT_EQ(plane.id, t.plane);
      EXPECT_EQ(plane.object, t.object);
      for (const Eigen::Vector3d& x_w : t.corners_w) {
        EXPECT_NEAR(plane.n_w.dot(x_w) + plane.d, 0, kVolumeRoundOff_m);
      }
      EXPECT_EQ(t.normals_w[0], plane.n_w);
    }
  }
}

TEST(BuildMesh, MeasuresPrintInMetresAndNeverMirrorsIt) {
  for (const Triangle& t : BuildMesh(MakeScene("desk", 1)).triangles) {
    if (t.plane == 0) continue;
    const Eigen::Vector2d du = t.uv_m[1] - t.uv_m[0], dv = t.uv_m[2] - t.uv_m[0];
    EXPECT_NEAR(du.norm(), (t.corners_w[1] - t.corners_w[0]).norm(), kVolumeRoundOff_m);
    EXPECT_NEAR(dv.norm(), (t.corners_w[2] - t.corners_w[0]).norm(), kVolumeRoundOff_m);
    EXPECT_GT(du.x() * dv.y() - du.y() * dv.x(), 0);
  }
}

TEST(BuildMesh, FillsTheBoxOfAToyWithACurvedBody) {
  const Scene scene = MakeScene("desk", 1);
  for (const Object& object : scene.objects) {
    if (object.shape != ShapeKind::kToy) continue;
    Eigen::AlignedBox3d extent;
    int triangles = 0;
    for (const Triangle& t : BuildMesh(scene).triangles) {
      if (t.object != object.id) continue;
      ++triangles;
      EXPECT_EQ(t.plane, 0);
      for (const Eigen::Vector3d& x_w : t.corners_w) {
        extent.extend(object.q_wo.inverse() * (x_w - object.center_w));
      }
    }
    EXPECT_GE(triangles, 200);
    EXPECT_LT((extent.sizes() - object.size).norm(), 1e-9);
    return;
  }
  FAIL() << "the desk has no toy";
}

/// A lump as a mesh of one's own, without a flat part.
Object OwnLump() {
  const ClosedSurface lump = ToySurface({0.2, 0.1, 0.15}, 3);
  auto model = std::make_shared<Model>();
  model->size = {0.2, 0.1, 0.15};
  model->vertices_o = lump.vertices_o;
  model->triangles = lump.triangles;
  model->plane_of.assign(lump.triangles.size(), -1);
  model->colour_of.assign(lump.triangles.size(), 0);
  model->colours = {{0.5, 0.4, 0.3}};
  Object object;
  object.id = 1;
  object.shape = ShapeKind::kMesh;
  object.size = model->size;
  object.model = model;
  return object;
}

TEST(BuildMesh, TurnsTheShadingOfARoundMeshWithIt) {
  Scene scene;
  scene.objects = {OwnLump()};
  const SceneMesh upright = BuildMesh(scene);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(2.0, Eigen::Vector3d(1, -2, 3).normalized()));
  scene.objects[0].q_wo = turn;
  const SceneMesh turned = BuildMesh(scene);
  ASSERT_EQ(turned.triangles.size(), upright.triangles.size());
  for (std::size_t k = 0; k < turned.triangles.size(); ++k) {
    const Triangle& t = turned.triangles[k];
    const Eigen::Vector3d face =
        (t.corners_w[1] - t.corners_w[0]).cross(t.corners_w[2] - t.corners_w[0]);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_GT(t.normals_w[i].dot(face), 0) << "lit from within";
      EXPECT_LT((t.normals_w[i] - turn * upright.triangles[k].normals_w[i]).norm(), 1e-12);
    }
  }
}

// Where what moves stands among the others, theirs are the planes that the scene has of them.
TEST(BuildMesh, NumbersItsPlanesAsTheSceneDoesWhateverMoves) {
  const Scene desk = MakeScene("desk", 3);
  for (const std::size_t mover : {std::size_t{0}, desk.objects.size() / 2}) {
    Scene scene = desk;
    Object& moves = scene.objects[mover];
    moves.way = {{0, moves.center_w, 0}, {1, moves.center_w + Eigen::Vector3d::UnitX(), 0}};
    const std::vector<ScenePlane> planes = ScenePlanes(scene);
    std::set<int> shown;
    for (const Triangle& t : BuildMesh(scene).triangles) {
      ASSERT_TRUE(t.plane == 0 || t.object != moves.id);
      if (t.plane == 0) continue;
      const ScenePlane& plane = planes.at(static_cast<std::size_t>(t.plane) - 1);
      ASSERT_EQ(plane.object, t.object);
      for (const Eigen::Vector3d& x_w : t.corners_w)
        EXPECT_NEAR(plane.n_w.dot(x_w) + plane.d, 0, 1e-12);
      shown.insert(t.plane);
    }
    EXPECT_EQ(shown.size(), planes.size());
  }
}

TEST(ScenePlanes, LieOutsideTheirOwnerAndTurnTheirVerticesLeft) {
  const Scene scene = MakeScene("desk", 2);
  for (const ScenePlane& plane : ScenePlanes(scene)) {
    const Object& owner = scene.objects.at(static_cast<std::size_t>(plane.object - 1));
    EXPECT_LT(plane.n_w.dot(owner.center_w) + plane.d, 0);
    EXPECT_NEAR(plane.n_w.norm(), 1, kVolumeRoundOff_m);
    const auto& v = plane.vertices_w;
    const Eigen::Vector3d twice = (v[1] - v[0]).cross(v[2] - v[0]);
    EXPECT_NEAR(twice.dot(plane.n_w), plane.area_m2, kVolumeRoundOff_m);
  }
}

TEST(ScenePlanes, CountSixForEveryBoxAndNoneForAToy) {
  const Scene scene = MakeScene("desk", 4);
  std::size_t boxes = 0;
  for (const Object& object : scene.objects) boxes += object.shape == ShapeKind::kBox ? 1 : 0;
  EXPECT_EQ(ScenePlanes(scene).size(), 6 * boxes);
}

}  // namespace
}  // namespace sim
