#include "sim/truth/truth_json.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/shapes/planes.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// A box that turns from 20 to 60 degrees about the upright while it goes to the right.
Scene TurningBox() {
  Scene scene = OneBoard(2.0);
  Object box = BoxObject(2, "box", Role::kUnstructured, {-0.2, 1, 0}, {0.3, 0.2, 0.1});
  box.way = {{0, {-0.2, 1, 0}, 20}, {1, {0.2, 1, 0}, 60}};
  scene.objects.push_back(box);
  return scene;
}

/// What a file tells of the box of TurningBox.
nlohmann::json TurningBoxIn(const std::string& text) {
  const auto json = nlohmann::json::parse(text);
  for (const auto& object : json.at("objects")) {
    if (object["id"] == 2) return object;
  }
  return {};
}

Pose PoseToldIn(const nlohmann::json& object) {
  const auto& q = object.at("q_xyzw");
  const auto& at = object.at("center");
  return {Eigen::Quaterniond(q[3], q[0], q[1], q[2]).toRotationMatrix(),
          Eigen::Vector3d(at[0], at[1], at[2])};
}

Pose PoseInFrameAt(double time_s) {
  const FrameRenderer renderer(TurningBox(), SmallCamera());
  RenderOptions options;
  options.colour = false;
  options.time_s = time_s;
  const Rendering seen = renderer.Render(LookAlongY(), options);
  const FrameTruth truth = TruthMaker(renderer).Describe(seen, LookAlongY(), time_s);
  return PoseToldIn(TurningBoxIn(FrameTruthJson(time_s, truth)));
}

// A quarter of the way: 30 degrees. The box's x runs to the right and away, its y to the left.
TEST(FrameTruthJson, TakesPointsOfWhatTurnsFromItsOwnFrameToTheWorld) {
  const Pose T_wo = PoseInFrameAt(0.25);
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  EXPECT_NEAR((T_wo * Eigen::Vector3d::Zero() - Eigen::Vector3d(-0.1, 1, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((T_wo.R.col(0) - Eigen::Vector3d(c, s, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((T_wo.R.col(1) - Eigen::Vector3d(-s, c, 0)).norm(), 0, 1e-12);
}

TEST(FrameTruthJson, PutsWhatMovesWhereTheScenesTruthHasItAtTheFirstPointOfItsWay) {
  const Scene scene = TurningBox();
  const Pose first = PoseInFrameAt(0);
  const Pose told = PoseToldIn(TurningBoxIn(SceneTruthJson(scene, ScenePlanes(scene))));
  EXPECT_NEAR((first.R - told.R).norm(), 0, 1e-12);
  EXPECT_NEAR((first.t - told.t).norm(), 0, 1e-12);
}

}  // namespace
}  // namespace sim
