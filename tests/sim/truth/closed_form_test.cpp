// The scenes of scenes/closed_form and their answers on paper, as scenes/README.md gives them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>

#include "sim/scene/read_scene.h"
#include "sim/shapes/planes.h"
#include "sim/truth/frame_truth.h"
#include "sim/truth/plane_pairs.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(PAS_SOURCE_DIR) / "scenes/closed_form";

/// Without its prints, which take time to make and change nothing here.
Scene Read(const std::string& name) {
  Scene scene = ReadScene(kFolder / (name + ".yaml"));
  for (Object& object : scene.objects) {
    for (Material& face : object.faces) face.print = Print::kPlain;
  }
  return scene;
}

ScenePlane FaceOf(const Scene& scene, int object, Face face) {
  for (const ScenePlane& plane : ScenePlanes(scene)) {
    if (plane.object == object && plane.face == face) return plane;
  }
  return {};
}

void ExpectPlane(const ScenePlane& plane, const Eigen::Vector3d& n_w, double d) {
  EXPECT_LT((plane.n_w - n_w).norm(), 1e-12);
  EXPECT_NEAR(plane.d, d, 1e-12);
}

TEST(ClosedForm, EverySceneHasALineInTheReadme) {
  std::ifstream file(kFolder / "../README.md");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  for (const auto& entry : fs::directory_iterator(kFolder)) {
    const std::string name = "closed_form/" + entry.path().filename().string();
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

TEST(ClosedForm, WallIsThePlaneYZero) {
  const Scene scene = Read("wall");
  ExpectPlane(FaceOf(scene, 1, Face::kMinusY), {0, -1, 0}, 0);
  // Every pixel of a camera square to it, 1.1 m away, shows 1.1 m.
  const Rendering r = FrameRenderer(scene, SmallCamera())
                          .Render(LookAt({0.1, -1.1, 1.4}, {0.1, 0, 1.4}), {.colour = false});
  EXPECT_NEAR(r.depth_m(0, 0), 1.1, 1e-12);
  EXPECT_NEAR(r.depth_m(119, 159), 1.1, 1e-12);
}

TEST(ClosedForm, CornerIsWhereThreePlanesMeetInTheOrigin) {
  const Scene scene = Read("corner");
  ExpectPlane(FaceOf(scene, 1, Face::kPlusZ), {0, 0, 1}, 0);
  ExpectPlane(FaceOf(scene, 2, Face::kPlusX), {1, 0, 0}, 0);
  ExpectPlane(FaceOf(scene, 3, Face::kMinusY), {0, -1, 0}, 0);
}

TEST(ClosedForm, ParallelBoardsAreTwentyMillimetresApart) {
  const Scene scene = Read("parallel_boards");
  const ScenePlane low = FaceOf(scene, 2, Face::kPlusZ), high = FaceOf(scene, 3, Face::kPlusZ);
  ExpectPlane(low, {0, 0, 1}, -0.02);
  ExpectPlane(high, {0, 0, 1}, -0.04);
  for (const Eigen::Vector3d& x_w : low.vertices_w) {
    EXPECT_NEAR(std::abs(x_w.x() + 0.16), 0.15, 1e-12);
    EXPECT_NEAR(std::abs(x_w.y()), 0.15, 1e-12);
  }
  for (const PlanePair& pair : PlanePairs(scene, ScenePlanes(scene))) {
    if (pair.a != low.id || pair.b != high.id) continue;
    EXPECT_NEAR(pair.step_mm, 20, 1e-9);
    EXPECT_NEAR(pair.lateral_gap_mm, 20, 1e-9);
    return;
  }
  FAIL() << "the two tops are no pair";
}

// The board is 0.6 x 0.4 m; from 1 m its corners lie 0.3 f beside and 0.2 f above the centre.
TEST(ClosedForm, FrontoParallelBoardProjectsToARectangle) {
  const Scene scene = Read("fronto_parallel");
  const ScenePlane front = FaceOf(scene, 1, Face::kMinusY);
  ExpectPlane(front, {0, -1, 0}, 0);
  Camera camera;
  camera.cx += 0.25;  // or pixel centres would lie on the board's very edges
  const Pose T_wc = LookAt({0, -1, 1}, {0, 0, 1});
  const FrameRenderer renderer(scene, camera);
  const FrameTruth truth =
      TruthMaker(renderer).Describe(renderer.Render(T_wc, {.colour = false}), T_wc);
  ASSERT_EQ(truth.planes.size(), 1u);
  EXPECT_EQ(truth.planes[0].id, front.id);
  for (const VertexInFrame& vertex : truth.planes[0].vertices) {
    EXPECT_NEAR(std::abs(vertex.pixel.x() - camera.cx), 0.3 * camera.fx, 1e-9);
    EXPECT_NEAR(std::abs(vertex.pixel.y() - camera.cy), 0.2 * camera.fy, 1e-9);
    EXPECT_EQ(vertex.state, VertexState::kVisible);
    EXPECT_TRUE(vertex.surface_ends);
  }
  EXPECT_NEAR(truth.planes[0].pixels, 0.6 * 0.4 * camera.fx * camera.fy,
              camera.fx);  // one pixel along its outline
}

// A step over the floor is the board's thickness, in units of 1.884 mm.
TEST(ClosedForm, StaircaseIsTheMoreAmbiguousTheThinnerTheBoard) {
  const Scene scene = Read("staircase");
  const int floor = FaceOf(scene, 1, Face::kPlusZ).id;
  const std::map<int, double> steps_mm{{2, 5}, {3, 10}, {4, 20}, {5, 40}};
  const std::vector<PlanePair> pairs = PlanePairs(scene, ScenePlanes(scene));
  for (const auto& [object, step_mm] : steps_mm) {
    const int top = FaceOf(scene, object, Face::kPlusZ).id;
    const auto found = std::find_if(pairs.begin(), pairs.end(), [&](const PlanePair& pair) {
      return pair.a == floor && pair.b == top;
    });
    ASSERT_NE(found, pairs.end()) << object;
    EXPECT_NEAR(found->step_mm, step_mm, 1e-9);
    EXPECT_EQ(found->lateral_gap_mm, 0);
    EXPECT_NEAR(found->step_sigmas, step_mm / 1.884, 1e-9);
  }
}

TEST(ClosedForm, HalfHiddenBoardIsHalfVisible) {
  const Scene scene = Read("half_hidden");
  const Pose T_wc = LookAt({0, 0, 1}, {0, 1, 1});
  const FrameRenderer renderer(scene, Camera{});
  const FrameTruth truth =
      TruthMaker(renderer).Describe(renderer.Render(T_wc, {.colour = false}), T_wc);
  ASSERT_EQ(truth.objects.size(), 2u);
  // 0.6 m at 2 m are 157.5 px; one column more or less is 0.0064 of them.
  EXPECT_NEAR(truth.objects[0].visible_fraction, 0.5, 0.0064);
  EXPECT_EQ(truth.objects[1].visible_fraction, 1.0);
  EXPECT_NEAR(truth.objects[0].amodal_box.x0, 319.5 - 525 * 0.15, 1e-9);
  EXPECT_NEAR(truth.objects[0].visible_box.x0, 319.5, 1);
}

}  // namespace
}  // namespace sim
