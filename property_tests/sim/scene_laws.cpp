#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/input_error.h"
#include "property_tests/generators/scenes.h"
#include "sim/motion/trajectory.h"
#include "sim/scene/check.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "sim/scene/write_scene.h"
#include "sim/shapes/planes.h"
#include "sim/shapes/steps.h"

namespace sim {
namespace {

// Coordinates stay below 6 m, each law under 100 flops: 100 * 6 * 2^-53 < 7e-14.
constexpr double kRoundOff_m = 1e-12;

RC_GTEST_PROP(SceneFamilies, MakeScenesThatCanBe, ()) {
  const SceneRecipe recipe = DrawAnyRecipe();
  RC_LOG() << recipe.Command();
  Scene scene;
  try {
    scene = recipe.Make();
  } catch (const io::InputError&) {
    RC_DISCARD("that many things do not fit on a desk of this size");
  }
  RC_ASSERT(!FindFault(scene).has_value());
  RC_ASSERT(SceneText(ParseScene(SceneText(scene), "text")) == SceneText(scene));
}

RC_GTEST_PROP(SceneFamilies, StepEveryRegularTopUpwards, ()) {
  const SceneRecipe recipe = DrawSceneRecipe();
  RC_LOG() << recipe.Command();
  const Scene scene = recipe.Make();
  const std::vector<TopStep> steps = TopSteps(scene, ScenePlanes(scene));
  RC_ASSERT(!steps.empty());
  for (const TopStep& step : steps) RC_ASSERT(step.step_mm > 0.5);
}

RC_GTEST_PROP(SceneFile, GivesBackAnyBoxBitForBit, ()) {
  Scene scene;
  scene.name = "any";
  scene.objects.push_back(DrawBox(1));
  scene.objects[0].center_w.z() += 3;
  const Scene read = ParseScene(SceneText(scene), "text");
  RC_ASSERT(read.objects[0].q_wo.coeffs() == scene.objects[0].q_wo.coeffs());
  RC_ASSERT(read.objects[0].center_w == scene.objects[0].center_w);
  RC_ASSERT(read.objects[0].size == scene.objects[0].size);
}

RC_GTEST_PROP(ScenePlanes, KeepEveryCornerOfTheBoxBehindThem, ()) {
  Scene scene;
  scene.objects.push_back(DrawBox(1));
  const std::vector<ScenePlane> planes = ScenePlanes(scene);
  RC_ASSERT(planes.size() == 6u);
  for (const ScenePlane& plane : planes) {
    int on_it = 0;
    for (const Eigen::Vector3d& corner : Corners(scene.objects[0])) {
      const double distance = plane.n_w.dot(corner) + plane.d;
      RC_ASSERT(distance < kRoundOff_m);
      on_it += std::abs(distance) < kRoundOff_m ? 1 : 0;
    }
    RC_ASSERT(on_it == 4);
  }
}

RC_GTEST_PROP(OverlapDepth, IsSymmetricAndMovesWithTheBoxes, ()) {
  Object a = DrawBox(1), b = DrawBox(2);
  const double depth = OverlapDepth(a, b);
  RC_ASSERT(std::abs(OverlapDepth(b, a) - depth) < kRoundOff_m);
  const Eigen::Quaterniond turn = QuaternionFromRpyDeg({DrawReal(0, 90), 20, 30});
  for (Object* box : {&a, &b}) {
    box->center_w = turn * box->center_w + Eigen::Vector3d(1, 2, 3);
    box->q_wo = turn * box->q_wo;
  }
  // Edges within 1e-9 of parallel give no axis of their own; the gap they would add is tiny.
  RC_ASSERT(std::abs(OverlapDepth(a, b) - depth) < 1e-8);
}

RC_GTEST_PROP(OverlapDepth, IsNegativeOnlyWhenNoPointIsShared, ()) {
  const Object a = DrawBox(1), b = DrawBox(2);
  bool shared = false;
  for (int i = 0; i < 11 * 11 * 11; ++i) {
    const Eigen::Vector3d part(i % 11 / 10.0 - 0.5, i / 11 % 11 / 10.0 - 0.5,
                               i / 121 / 10.0 - 0.5);
    shared = shared ||
             DistanceToBox(b, a.center_w + a.q_wo * part.cwiseProduct(a.size)) < -kRoundOff_m;
  }
  if (shared) RC_ASSERT(OverlapDepth(a, b) > 0);
}

RC_GTEST_PROP(MakeTrajectory, StaysClearOfEveryDesk, ()) {
  const Scene scene = DrawDesk();
  RC_LOG() << "pas scene make --family desk --seed " << scene.seed << ", preset "
           << scene.motion.preset;
  const auto seed = static_cast<std::uint64_t>(AnyInt(0, 100000));
  const auto trajectory = MakeTrajectory(scene, 150, 30, seed);
  for (const TimedPose& pose : trajectory) {
    for (const Object& object : scene.objects) {
      RC_ASSERT(DistanceToBox(object, pose.T_wc.t) >= 0.15);
    }
    const double sine = -pose.T_wc.R(2, 2);
    RC_ASSERT(sine >= SinCosDeg(25).sin);
    RC_ASSERT(sine <= SinCosDeg(45).sin);
  }
}

}  // namespace
}  // namespace sim
