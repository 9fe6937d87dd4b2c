#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "sim/shapes/mesh.h"
#include "tests/support/place.h"

namespace sim {
namespace {

class EveryShape : public testing::TestWithParam<ShapeKind> {
 protected:
  static Scene One() {
    Scene scene;
    Object object;
    object.id = 1;
    object.shape = GetParam();
    object.size = {0.08, 0.1, 0.12};
    object.seed = 3;
    scene.objects.push_back(object);
    return scene;
  }
};

TEST_P(EveryShape, IsClosedAndFillsItsBox) {
  const Scene scene = One();
  std::map<std::pair<Place, Place>, int> edges;
  Eigen::AlignedBox3d extent;
  double volume = 0;
  for (const Triangle& t : BuildMesh(scene).triangles) {
    volume += t.corners_w[0].dot(t.corners_w[1].cross(t.corners_w[2])) / 6;
    for (std::size_t i = 0; i < 3; ++i) {
      extent.extend(t.corners_w[i]);
      ++edges[{Nanometres(t.corners_w[i]), Nanometres(t.corners_w[(i + 1) % 3])}];
      EXPECT_NEAR(t.normals_w[i].norm(), 1, 1e-9);
    }
  }
  const double box = scene.objects[0].size.prod();
  EXPECT_GT(volume, 0.05 * box);
  EXPECT_LE(volume, box * (1 + 1e-12));
  EXPECT_LT((extent.sizes() - scene.objects[0].size).norm(), 1e-9);
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u) << "a hole";
  }
}

TEST_P(EveryShape, TurnsItsShadingNormalsOutwards) {
  for (const Triangle& t : BuildMesh(One()).triangles) {
    const Eigen::Vector3d face =
        (t.corners_w[1] - t.corners_w[0]).cross(t.corners_w[2] - t.corners_w[0]).normalized();
    for (const Eigen::Vector3d& n : t.normals_w) EXPECT_GT(n.dot(face), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape,
                         testing::Values(ShapeKind::kBox, ShapeKind::kToy, ShapeKind::kCylinder,
                                         ShapeKind::kMug, ShapeKind::kBottle, ShapeKind::kBowl,
                                         ShapeKind::kBush, ShapeKind::kPerson,
                                         ShapeKind::kHand));

TEST(Cylinder, HasTheVolumeOfItsPrism) {
  Scene scene;
  scene.objects.emplace_back();
  scene.objects[0].shape = ShapeKind::kCylinder;
  scene.objects[0].size = {2, 2, 3};
  double volume = 0;
  for (const Triangle& t : BuildMesh(scene).triangles) {
    volume += t.corners_w[0].dot(t.corners_w[1].cross(t.corners_w[2])) / 6;
  }
  EXPECT_NEAR(volume, 3 * 24 * std::sin(2 * M_PI / 48), 1e-12);  // 48 corners a circle
}

}  // namespace
}  // namespace sim
