#include "slam/tracking/motion_model.h"

#include <gmock/gmock.h>

#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kStep{ExpSo3({0.01, -0.02, 0.005}), {0.01, 0.0, -0.02}};
const Pose kStart{ExpSo3({0.3, 0.2, -0.4}), {1.0, 2.0, 0.5}};
constexpr double kRoundOff = 1e-12;

TEST(MotionModel, KnowsNothingBeforeTwoFrames) {
  MotionModel model;
  EXPECT_FALSE(model.Predict(0));
  model.Observe(0, kStart);
  EXPECT_FALSE(model.Predict(1));
}

TEST(MotionModel, RepeatsTheLastStep) {
  MotionModel model;
  model.Observe(0, kStart);
  model.Observe(1, kStep * kStart);
  EXPECT_THAT(*model.Predict(2), PoseNear(kStep * kStep * kStart, kRoundOff, kRoundOff));
}

TEST(MotionModel, CountsTheTimeInBetween) {
  MotionModel model;
  model.Observe(0, kStart);
  model.Observe(2, kStep * kStep * kStart);
  EXPECT_THAT(*model.Predict(3), PoseNear(kStep * kStep * kStep * kStart, 1e-9, 1e-9));
  EXPECT_THAT(*model.Predict(2.5),
              PoseNear(Exp(0.5 * Log(kStep)) * kStep * kStep * kStart, 1e-9, 1e-9));
}

TEST(MotionModel, KeepsTheStepWhenTheMapMovesUnderTheLastPose) {
  MotionModel model;
  model.Observe(0, kStart);
  model.Observe(1, kStep * kStart);
  const Pose corrected = Pose{ExpSo3({0, 0.01, 0}), {0, 0.005, 0}} * kStart;
  model.Correct(corrected);
  EXPECT_THAT(*model.Predict(2), PoseNear(kStep * corrected, kRoundOff, kRoundOff));
}

TEST(MotionModel, ForgetsItsSpeed) {
  MotionModel model;
  model.Observe(0, kStart);
  model.Observe(1, kStep * kStart);
  model.Forget();
  EXPECT_FALSE(model.Predict(2));
  model.Observe(2, kStart);  // and where it was: from there to here is no speed
  EXPECT_FALSE(model.Predict(3));
}

TEST(MotionModel, RefusesFramesOutOfOrder) {
  MotionModel model;
  model.Observe(3, kStart);
  EXPECT_THROW(model.Observe(3, kStart), std::invalid_argument);
  EXPECT_THROW(model.Observe(2.9, kStart), std::invalid_argument);
}

}  // namespace
}  // namespace slam
