#include "sim/truth/frame_truth.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "sim/truth/truth_json.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// Left half of the far board hidden by a near one; camera at the origin, looking along +y.
Scene HalfHidden() {
  Scene scene;
  scene.objects = {BoxObject(1, "book", Role::kRegular, {0, 2.05, 0}, {1.0, 0.1, 0.6}),
                   BoxObject(2, "box", Role::kRegular, {-0.5, 1.05, 0}, {1.0, 0.1, 0.6})};
  return scene;
}

FrameTruth TruthOf(const Scene& scene, const Camera& camera, const Pose& T_wc) {
  const FrameRenderer renderer(scene, camera);
  return TruthMaker(renderer).Describe(renderer.Render(T_wc), T_wc);
}

TEST(FrameTruth, CountsHalfABoardAsHalfVisible) {
  const FrameTruth truth = TruthOf(HalfHidden(), Camera{}, LookAlongY());
  ASSERT_EQ(truth.objects.size(), 2u);
  const ObjectInFrame& far = truth.objects[0];
  EXPECT_EQ(far.id, 1);
  EXPECT_NEAR(far.visible_fraction, 0.5, 0.01);  // one pixel column of 262
  EXPECT_EQ(truth.objects[1].visible_fraction, 1.0);
}

TEST(FrameTruth, BoxesTheVisiblePartAndTheWhole) {
  const Camera camera;
  const ObjectInFrame far = TruthOf(HalfHidden(), camera, LookAlongY()).objects[0];
  const double left = camera.cx - camera.fx * 0.25, right = camera.cx + camera.fx * 0.25;
  EXPECT_NEAR(far.visible_box.x0, camera.cx, 1.0);
  EXPECT_NEAR(far.visible_box.x1, right, 1.0);
  EXPECT_NEAR(far.amodal_box.x0, left, 1e-9);
  EXPECT_NEAR(far.amodal_box.x1, right, 1e-9);
  EXPECT_NEAR(far.amodal_box.y0, camera.cy - camera.fy * 0.15, 1e-9);
}

TEST(FrameTruth, LetsTheAmodalBoxReachOutsideTheImage) {
  const ObjectInFrame near = TruthOf(HalfHidden(), Camera{}, LookAlongY()).objects[1];
  EXPECT_NEAR(near.amodal_box.x0, 319.5 - 525 * 1.0, 1e-9);
  EXPECT_EQ(near.visible_box.x0, 0);
}

TEST(FrameTruth, CutsWhatReachesBehindTheCamera) {
  Scene scene;
  scene.objects = {BoxObject(1, "floor", Role::kStructure, {0, 0, -1.05}, {6, 6, 0.1})};
  const FrameTruth truth = TruthOf(scene, SmallCamera(), LookAlongY());
  ASSERT_EQ(truth.objects.size(), 1u);
  const PixelBox& box = truth.objects[0].amodal_box;
  EXPECT_TRUE(std::isfinite(box.y1) && box.y1 > 120);
  EXPECT_GT(box.y0, 59);  // the far edge, below the horizon
}

TEST(FrameTruth, SumsPixelsOfPlanesToThoseOfTheirObject) {
  const Scene scene = SmallDesk();
  const FrameTruth truth = TruthOf(scene, SmallCamera(), SmallArc(1)[0].T_wc);
  std::map<int, int> of_object;
  const std::vector<ScenePlane> planes = ScenePlanes(scene);
  for (const PlaneInFrame& plane : truth.planes) {
    of_object[planes.at(static_cast<std::size_t>(plane.id) - 1).object] += plane.pixels;
  }
  for (const ObjectInFrame& object : truth.objects) {
    EXPECT_EQ(of_object[object.id], object.id == 7 ? 0 : object.pixels) << object.id;
  }
}

TEST(ProjectedBox, IsEmptyForWhatLiesBehind) {
  const SceneMesh mesh = BuildMesh(HalfHidden());
  EXPECT_FALSE(
      ProjectedBox(mesh.triangles, LookAt({0, 3, 0}, {0, 4, 0}), Camera{}).has_value());
}

TEST(SceneTruth, ListsEveryFaceWithItsOwnerEvenIfItIsNeverSeen) {
  const Scene scene = SmallDesk();
  const auto json = nlohmann::json::parse(SceneTruthJson(scene));
  EXPECT_EQ(json["format"], "pas-scene-gt/1");
  EXPECT_EQ(json["objects"].size(), 7u);
  EXPECT_EQ(json["planes"].size(), 36u);
  EXPECT_EQ(json["objects"][0]["role"], "structure");
  EXPECT_EQ(json["objects"][3]["role"], "regular");
  EXPECT_EQ(json["objects"][3]["regular"], true);
  EXPECT_EQ(json["objects"][6]["role"], "unstructured");
  for (const auto& plane : json["planes"]) {
    const Eigen::Vector3d n(plane["normal"][0], plane["normal"][1], plane["normal"][2]);
    for (const auto& vertex : plane["vertices"]) {
      const Eigen::Vector3d x(vertex[0], vertex[1], vertex[2]);
      EXPECT_NEAR(n.dot(x) + plane["d"].get<double>(), 0, 1e-12);
    }
    EXPECT_EQ(plane["vertices"].size(), 4u);
  }
}

}  // namespace
}  // namespace sim
