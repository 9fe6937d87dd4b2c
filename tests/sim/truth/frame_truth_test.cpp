#include "sim/truth/frame_truth.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/core.hpp>
#include <set>

#include "sim/shapes/planes.h"
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

// A board, one before it and a toy are one thing; a book stands before them and hides the toy.
TEST(FrameTruth, CountsWhatAGroupWouldShowTogetherAndAlone) {
  Scene scene = HalfHidden();
  scene.objects.push_back(
      BoxObject(3, "teddy bear", Role::kOther, {0.6, 1.5, 0}, {0.1, 0.1, 0.1}));
  scene.objects[2].shape = ShapeKind::kToy;
  for (Object& object : scene.objects) object.detection_group = 7;
  for (const Camera& camera : {SmallCamera(), WithLens(SmallCamera(), {0.1, 0, 0, 0, 0})}) {
    const Rendering alone = FrameRenderer(scene, camera).Render(LookAlongY());
    Scene hidden = scene;
    hidden.objects.push_back(
        BoxObject(4, "book", Role::kRegular, {0.3, 0.75, 0}, {0.3, 0.1, 0.3}));
    const FrameTruth truth = TruthOf(hidden, camera, LookAlongY());
    EXPECT_EQ(std::count_if(truth.objects.begin(), truth.objects.end(),
                            [](const ObjectInFrame& object) { return object.id == 3; }),
              0);
    ASSERT_EQ(truth.unoccluded_pixels_of_group.size(), 1u);
    EXPECT_NEAR(truth.unoccluded_pixels_of_group.at(7), cv::countNonZero(alone.object_id), 1);
    EXPECT_GT(cv::countNonZero(alone.object_id == 3), 20);
  }
}

TEST(FrameTruth, LeavesStructureOutOfTheGroupsThatAreDetected) {
  Scene scene = HalfHidden();
  for (Object& object : scene.objects) object.detection_group = 7;
  scene.objects[0].role = Role::kStructure;
  const FrameTruth truth = TruthOf(scene, SmallCamera(), LookAlongY());
  ASSERT_EQ(truth.objects.size(), 2u);
  ASSERT_EQ(truth.unoccluded_pixels_of_group.size(), 1u);
  EXPECT_EQ(truth.unoccluded_pixels_of_group.at(7), truth.objects[1].pixels);
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
  ASSERT_FALSE(truth.objects.empty());
  for (const ObjectInFrame& object : truth.objects) {
    EXPECT_EQ(of_object[object.id], object.id == 7 ? 0 : object.pixels) << object.id;
  }
}

/// The front (-y) face of an object among the planes of a frame.
const PlaneInFrame* FrontOf(const FrameTruth& truth, const Scene& scene, int object) {
  const std::vector<ScenePlane> planes = ScenePlanes(scene);
  for (const PlaneInFrame& plane : truth.planes) {
    const ScenePlane& of = planes.at(static_cast<std::size_t>(plane.id) - 1);
    if (of.object == object && of.face == Face::kMinusY) return &plane;
  }
  return nullptr;
}

TEST(FrameTruth, OutlinesAFaceAsIfNothingHidIt) {
  const Camera camera;
  const Scene scene = HalfHidden();
  const FrameTruth truth = TruthOf(scene, camera, LookAlongY());
  const PlaneInFrame* far = FrontOf(truth, scene, 1);
  ASSERT_NE(far, nullptr);
  EXPECT_NEAR(std::abs(SignedArea(far->outline)), 525.0 / 2 * 525.0 * 0.6 / 2, 1e-6);
  const PlaneInFrame* near = FrontOf(truth, scene, 2);  // from u = -205.5, cut at -0.5
  ASSERT_NE(near, nullptr);
  EXPECT_NEAR(std::abs(SignedArea(near->outline)), 320.0 * 525.0 * 0.6, 1e-6);
}

TEST(FrameTruth, TellsVisibleHiddenAndOutsideCorners) {
  const Scene scene = HalfHidden();
  const FrameTruth truth = TruthOf(scene, Camera{}, LookAlongY());
  for (const int object : {1, 2}) {
    ASSERT_NE(FrontOf(truth, scene, object), nullptr);
    ASSERT_EQ(FrontOf(truth, scene, object)->vertices.size(), 4u);
  }
  for (const VertexInFrame& vertex : FrontOf(truth, scene, 1)->vertices) {
    EXPECT_EQ(vertex.state,
              vertex.x_w.x() > 0 ? VertexState::kVisible : VertexState::kOccluded);
    EXPECT_NEAR(vertex.pixel.x(), 319.5 + 525 * vertex.x_w.x() / 2, 1e-9);
  }
  for (const VertexInFrame& vertex : FrontOf(truth, scene, 2)->vertices) {
    EXPECT_EQ(vertex.state,
              vertex.x_w.x() > -0.5 ? VertexState::kVisible : VertexState::kOutside);
  }
}

// The image reaches half a pixel beyond the centres of its outer pixels.
TEST(FrameTruth, CallsCornersOnTheOuterHalfOfAPixelInside) {
  const Camera camera;
  for (const auto& [u, state] :
       {std::pair(-0.3, VertexState::kVisible), {-0.7, VertexState::kOutside}}) {
    const double half = 2 * (camera.cx - u) / camera.fx;  // 2 m away
    Scene scene;
    scene.objects = {
        BoxObject(1, "board", Role::kStructure, {0, 2.05, 0}, {2 * half, 0.1, 0.6})};
    const FrameTruth truth = TruthOf(scene, camera, LookAlongY());
    for (const VertexInFrame& vertex : FrontOf(truth, scene, 1)->vertices) {
      EXPECT_NEAR(std::abs(vertex.pixel.x() - camera.cx), camera.cx - u, 1e-9);
      EXPECT_EQ(vertex.state, state) << vertex.pixel.transpose();
    }
  }
}

// A book lies on the near half of a desk, its back edge in the desk's middle; the camera looks
// from the front, above, over the book's middle. Depth breaks off at the book's four upper
// corners; at the two lower ones that are seen, book and desk meet.
TEST(FrameTruth, TellsCornersWhereDepthBreaksOffFromCreases) {
  Scene scene;
  scene.objects = {BoxObject(1, "desk", Role::kStructure, {0, 1.5, -0.515}, {1.6, 1.0, 0.03}),
                   BoxObject(2, "book", Role::kRegular, {0, 1.35, -0.485}, {0.2, 0.3, 0.03})};
  const FrameTruth truth = TruthOf(scene, Camera{}, LookAt({0, 0, 0.3}, {0, 1.4, -0.5}));
  std::map<double, int> ends_by_height, seen_by_height;
  for (const PlaneInFrame& plane : truth.planes) {
    if (plane.id <= 6) continue;
    for (const VertexInFrame& vertex : plane.vertices) {
      if (vertex.state != VertexState::kVisible) continue;
      ++seen_by_height[vertex.x_w.z()];
      ends_by_height[vertex.x_w.z()] += vertex.surface_ends ? 1 : 0;
    }
  }
  // The top has four corners; the front shares two of them and has two below.
  ASSERT_EQ(seen_by_height.size(), 2u);
  EXPECT_EQ(seen_by_height.begin()->second, 2);
  EXPECT_EQ(ends_by_height.begin()->second, 0);
  EXPECT_EQ(seen_by_height.rbegin()->second, 6);
  EXPECT_EQ(ends_by_height.rbegin()->second, 6);
}

TEST(FrameTruth, PutsEveryPixelOfAPlaneInsideItsOutline) {
  const Scene scene = SmallDesk();
  const Pose T_wc = SmallArc(1)[0].T_wc;
  const FrameRenderer renderer(scene, SmallCamera());
  const Rendering rendering = renderer.Render(T_wc, {.colour = false});
  int pixels = 0;
  for (const PlaneInFrame& plane : TruthMaker(renderer).Describe(rendering, T_wc).planes) {
    ASSERT_GE(plane.outline.size(), 3u);
    const double turn = SignedArea(plane.outline) < 0 ? -1 : 1;
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        if (rendering.plane_id(v, u) != plane.id) continue;
        ++pixels;
        for (std::size_t i = 0; i < plane.outline.size(); ++i) {
          const Eigen::Vector2d a = plane.outline[i];
          const Eigen::Vector2d ab = plane.outline[(i + 1) % plane.outline.size()] - a;
          const Eigen::Vector2d ap = Eigen::Vector2d(u, v) - a;
          const double inside = turn * (ab.x() * ap.y() - ab.y() * ap.x());
          ASSERT_GE(inside, -1e-3 * ab.norm()) << plane.id << " at " << u << ", " << v;
        }
      }
    }
  }
  EXPECT_GT(pixels, 1000);
}

TEST(FrameTruth, WritesOutlineAndCornersOfEachPlane) {
  const Scene scene = HalfHidden();
  const auto json =
      nlohmann::json::parse(FrameTruthJson(0.0, TruthOf(scene, SmallCamera(), LookAlongY())));
  ASSERT_EQ(json["planes"].size(), 2u);
  EXPECT_EQ(json["planes"][0]["outline"].size(), 4u);
  ASSERT_EQ(json["planes"][0]["vertices"].size(), 4u);
  EXPECT_EQ(json["planes"][0]["vertices"][0]["world"].size(), 3u);
  EXPECT_EQ(json["planes"][0]["vertices"][0]["pixel"].size(), 2u);
}

TEST(ProjectedBox, IsEmptyForWhatLiesBehind) {
  const SceneMesh mesh = BuildMesh(HalfHidden());
  EXPECT_FALSE(
      ProjectedBox(mesh.triangles, LookAt({0, 3, 0}, {0, 4, 0}), Camera{}).has_value());
}

TEST(SceneTruth, ListsEveryHoleOfAFace) {
  const Scene scene = HalfHidden();
  std::vector<ScenePlane> planes = ScenePlanes(scene);
  planes[0].holes_w = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{2, 0, 0}, {3, 0, 0}, {2, 1, 0}}};
  const auto truth = nlohmann::json::parse(SceneTruthJson(scene, planes));
  ASSERT_EQ(truth["planes"][0]["holes"].size(), 2u);
  EXPECT_EQ(truth["planes"][0]["holes"][0][1], nlohmann::json({1.0, 0.0, 0.0}));
  EXPECT_EQ(truth["planes"][0]["holes"][1][0], nlohmann::json({2.0, 0.0, 0.0}));
  EXPECT_FALSE(truth["planes"][1].contains("holes"));
}

TEST(SceneTruth, ListsEveryFaceWithItsOwnerEvenIfItIsNeverSeen) {
  const Scene scene = SmallDesk();
  const auto json = nlohmann::json::parse(SceneTruthJson(scene, ScenePlanes(scene)));
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
