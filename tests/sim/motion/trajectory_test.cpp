#include "sim/motion/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/families.h"
#include "sim/scene/geometry.h"
#include "sim/scene/read_scene.h"
#include "tests/support/trajectory_means.h"

namespace sim {
namespace {

constexpr std::uint64_t kSeeds = 20;
constexpr int kFrames = 300;
constexpr double kFps = 30;

std::vector<TimedPose> DeskTrajectory(const std::string& preset, std::uint64_t seed) {
  Scene scene = MakeScene("desk", seed);
  scene.motion.preset = preset;
  return MakeTrajectory(scene, kFrames, kFps, seed);
}

class HandMotion : public testing::TestWithParam<const char*> {};

TEST_P(HandMotion, LooksDownOnTheDeskFromAnArmsLength) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    Scene scene = MakeScene("desk", seed);
    const Object desk = scene.objects.at(3);
    ASSERT_EQ(desk.name, "desk");
    const double top_z = desk.center_w.z() + desk.size.z() / 2;
    for (const TimedPose& pose : DeskTrajectory(GetParam(), seed)) {
      const Eigen::Vector3d forward_w = pose.T_wc.R.col(2);
      const double pitch_deg = RadToDeg(std::asin(-forward_w.z()));
      ASSERT_GE(pitch_deg, 25) << seed;
      ASSERT_LE(pitch_deg, 45) << seed;
      const double distance = (pose.T_wc.t.z() - top_z) / -forward_w.z();
      ASSERT_GE(distance, 0.5) << seed;
      ASSERT_LE(distance, 1.5) << seed;
      const Eigen::Vector3d seen_w = pose.T_wc.t + distance * forward_w;  // image centre
      ASSERT_LE(std::abs(seen_w.x()), desk.size.x() / 2) << seed;
      ASSERT_LE(std::abs(seen_w.y()), desk.size.y() / 2) << seed;
    }
  }
}

TEST_P(HandMotion, KeepsFifteenCentimetresFromEverySurface) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Scene scene = MakeScene("desk", seed);
    for (const TimedPose& pose : DeskTrajectory(GetParam(), seed)) {
      for (const Object& object : scene.objects) {
        ASSERT_GE(DistanceToBox(object, pose.T_wc.t), 0.15) << seed << " " << object.name;
      }
    }
  }
}

TEST_P(HandMotion, ChangesItsVelocityContinuously) {
  Scene scene = MakeScene("desk", 1);
  scene.motion.preset = GetParam();
  EXPECT_LT(LargestChange(scene, 4000), 0.15 * LargestChange(scene, 400));
}

INSTANTIATE_TEST_SUITE_P(Presets, HandMotion, testing::Values("slow", "office", "fast"),
                         [](const auto& one) { return std::string(one.param); });

TEST(MakeTrajectory, BeginsALongerOneWithTheFramesOfAShorterOne) {
  const Scene scene = MakeScene("desk", 2);
  const auto short_one = MakeTrajectory(scene, 90, kFps, 7);
  const auto long_one = MakeTrajectory(scene, 3000, kFps, 7);
  for (std::size_t i = 0; i < short_one.size(); ++i) {
    EXPECT_EQ(short_one[i].T_wc.R, long_one[i].T_wc.R);
    EXPECT_EQ(short_one[i].T_wc.t, long_one[i].T_wc.t);
  }
}

TEST(MakeTrajectory, SamplesOneMotionAtAnyRate) {
  const Scene scene = MakeScene("desk", 2);
  const auto at_30 = MakeTrajectory(scene, 60, 30, 7);
  const auto at_60 = MakeTrajectory(scene, 120, 60, 7);
  for (std::size_t i = 0; i < at_30.size(); ++i) {
    EXPECT_EQ(at_30[i].timestamp_s, static_cast<double>(i) / 30);
    EXPECT_LT((at_30[i].T_wc.t - at_60[2 * i].T_wc.t).norm(), 1e-12);
  }
}

TEST(MakeTrajectory, DiffersBySeedAndRepeatsByIt) {
  const Scene scene = MakeScene("desk", 2);
  const auto one = MakeTrajectory(scene, 10, kFps, 1),
             same = MakeTrajectory(scene, 10, kFps, 1);
  const auto other = MakeTrajectory(scene, 10, kFps, 2);
  EXPECT_EQ(one.back().T_wc.t, same.back().T_wc.t);
  EXPECT_NE(one.back().T_wc.t, other.back().T_wc.t);
}

TEST(MakeTrajectory, KeepsRotationsProperOverALongTime) {
  for (const TimedPose& pose : MakeTrajectory(MakeScene("desk", 1), 3000, kFps, 1)) {
    const Eigen::Matrix3d& R = pose.T_wc.R;
    ASSERT_LT((R * R.transpose() - Eigen::Matrix3d::Identity()).norm(), 1e-14);
    ASSERT_GT(R.determinant(), 0);
    ASSERT_LT(R(2, 1), 0) << "the image's y must point down";
  }
}

TEST(MakeTrajectory, MovesInEverySceneOfTheCatalogue) {
  for (const char* name :
       {"closed_form/wall", "closed_form/corner", "closed_form/parallel_boards",
        "closed_form/fronto_parallel", "ambiguous/desk"}) {
    const Scene scene =
        ReadScene(std::string(PAS_SOURCE_DIR) + "/scenes/" + std::string(name) + ".yaml");
    const auto trajectory = MakeTrajectory(scene, kFrames, kFps, 1);
    EXPECT_GT(MeansOf(trajectory).speed_m_s, 0.1) << name;
    for (const TimedPose& pose : trajectory) {
      for (const Object& object : scene.objects) {
        ASSERT_GE(DistanceToBox(object, pose.T_wc.t), 0.15) << name;
      }
    }
  }
}

TEST(MakeTrajectory, MovesAlongLimitsWithoutWidth) {
  for (const int fixed : {0, 1, 2, 3}) {
    Scene scene = MakeScene("desk", 1);
    Motion& m = scene.motion;
    m.preset = "slow";
    if (fixed == 0) m.target_spread_m = 0;
    if (fixed == 1) m.distance_min_m = m.distance_max_m = 1.1;
    if (fixed == 2) m.azimuth_min_rad = m.azimuth_max_rad = 0.2;
    if (fixed == 3) m.pitch_min_rad = m.pitch_max_rad = 0.6;
    Eigen::AlignedBox3d extent;
    for (const TimedPose& pose : MakeTrajectory(scene, 300, kFps, 1))
      extent.extend(pose.T_wc.t);
    EXPECT_GT(extent.sizes().norm(), 0.2) << fixed;
  }
}

TEST(MakeTrajectory, SaysWhenNoLimitHasAnyWidth) {
  for (const char* preset : {"slow", "orbit"}) {
    Scene scene = MakeScene("desk", 1);
    Motion& m = scene.motion;
    m.preset = preset;
    m.target_spread_m = 0;
    m.distance_min_m = m.distance_max_m = 1.1;
    m.azimuth_min_rad = m.azimuth_max_rad = 0.2;
    m.pitch_min_rad = m.pitch_max_rad = 0.6;
    EXPECT_THROW(MakeTrajectory(scene, 10, kFps, 1), io::InputError) << preset;
  }
}

TEST(MakeTrajectory, SaysWhenThereIsNoPlaceForTheCamera) {
  Scene scene = MakeScene("desk", 1);
  scene.motion.distance_min_m = scene.motion.distance_max_m = 0.1;  // inside the desk's margin
  EXPECT_THROW(MakeTrajectory(scene, 10, kFps, 1), io::InputError);
  scene = MakeScene("desk", 1);
  scene.motion.preset = "running";
  EXPECT_THROW(MakeTrajectory(scene, 10, kFps, 1), io::InputError);
  EXPECT_THROW(MakeTrajectory(MakeScene("desk", 1), 0, kFps, 1), std::invalid_argument);
  EXPECT_THROW(MakeTrajectory(MakeScene("desk", 1), 10, 0, 1), std::invalid_argument);
}

}  // namespace
}  // namespace sim
