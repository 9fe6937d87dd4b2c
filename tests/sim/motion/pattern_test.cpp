#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "io/input_error.h"
#include "io/sha256.h"
#include "sim/base/angle.h"
#include "sim/families/families.h"
#include "sim/families/twin.h"
#include "sim/motion/pattern.h"
#include "sim/motion/trajectory.h"
#include "sim/scene/geometry.h"
#include "tests/support/trajectory_means.h"

namespace sim {
namespace {

constexpr int kPatternFrames = 600;
constexpr double kPatternFps = 30;

Scene DeskWith(const std::string& preset, std::uint64_t seed) {
  Scene scene = MakeScene("desk", seed);
  scene.motion.preset = preset;
  return scene;
}

struct Wanted {
  const char* preset;
  double speed_m_s, turn_deg_s;
};

class PatternMotion : public testing::TestWithParam<Wanted> {};

TEST_P(PatternMotion, HasTheSpeedsOfItsPresetWithinFifteenPerCent) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const auto trajectory =
        MakeTrajectory(DeskWith(GetParam().preset, seed), kPatternFrames, kPatternFps, seed);
    const Means means = MeansOf(trajectory);
    EXPECT_NEAR(means.speed_m_s, GetParam().speed_m_s, 0.15 * GetParam().speed_m_s) << seed;
    EXPECT_NEAR(means.turn_deg_s, GetParam().turn_deg_s, 0.15 * GetParam().turn_deg_s) << seed;
  }
}

TEST_P(PatternMotion, KeepsFifteenCentimetresFromEverySurface) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scene scene = DeskWith(GetParam().preset, seed);
    for (const TimedPose& pose : MakeTrajectory(scene, kPatternFrames, kPatternFps, seed)) {
      for (const Object& object : scene.objects) {
        ASSERT_GE(DistanceToBox(object, pose.T_wc.t), 0.15) << seed << " " << object.name;
      }
    }
  }
}

TEST_P(PatternMotion, ChangesItsVelocityContinuously) {
  const Scene scene = DeskWith(GetParam().preset, 1);
  EXPECT_LT(LargestChange(scene, 4000), 0.15 * LargestChange(scene, 400));
}

TEST_P(PatternMotion, BeginsALongerOneWithTheFramesOfAShorterOne) {
  const Scene scene = DeskWith(GetParam().preset, 2);
  const auto short_one = MakeTrajectory(scene, 60, kPatternFps, 7);
  const auto long_one = MakeTrajectory(scene, 300, kPatternFps, 7);
  for (std::size_t i = 0; i < short_one.size(); ++i) {
    EXPECT_EQ(short_one[i].T_wc.R, long_one[i].T_wc.R);
    EXPECT_EQ(short_one[i].T_wc.t, long_one[i].T_wc.t);
  }
}

INSTANTIATE_TEST_SUITE_P(Presets, PatternMotion,
                         testing::Values(Wanted{"xyz", 0.304, 17.2}, Wanted{"rpy", 0.06, 50},
                                         Wanted{"360", 0.21, 42}, Wanted{"orbit", 0.25, 16},
                                         Wanted{"loop", 0.254, 14.1},
                                         Wanted{"lookaway", 0.20, 25}),
                         [](const auto& one) { return std::string(one.param.preset); });

struct Reach {
  Eigen::Vector3d size;
  double least_facing = 1;  ///< cosine to the direction of the target
  double all_round = 0;     ///< degrees of azimuth that were looked at
};

Reach ReachOf(const std::string& preset) {
  const Scene scene = DeskWith(preset, 3);
  Eigen::AlignedBox3d box;
  Reach reach;
  std::vector<bool> seen(36);
  for (const TimedPose& pose : MakeTrajectory(scene, 900, kPatternFps, 3)) {
    box.extend(pose.T_wc.t);
    const Eigen::Vector3d forward = pose.T_wc.R.col(2);
    reach.least_facing = std::min(
        reach.least_facing, forward.dot((scene.motion.target_w - pose.T_wc.t).normalized()));
    const double azimuth = RadToDeg(std::atan2(forward.y(), forward.x())) + 180;
    seen[static_cast<std::size_t>(azimuth / 10) % 36] = true;
  }
  reach.size = box.sizes();
  reach.all_round = 10 * static_cast<double>(std::count(seen.begin(), seen.end(), true));
  return reach;
}

TEST(PatternMotion, MovesAsItsNameSays) {
  const Reach xyz = ReachOf("xyz"), rpy = ReachOf("rpy"), round = ReachOf("360");
  const Reach away = ReachOf("lookaway"), orbit = ReachOf("orbit");
  for (int axis = 0; axis < 3; ++axis) EXPECT_GT(xyz.size[axis], 0.12) << axis;
  EXPECT_GT(xyz.least_facing, std::cos(DegToRad(40)));
  EXPECT_LT(rpy.size.maxCoeff(), 0.15);
  EXPECT_EQ(round.all_round, 360);
  EXPECT_LT(away.least_facing, std::cos(DegToRad(80)));
  EXPECT_GT(orbit.least_facing, std::cos(DegToRad(30)));
}

TEST(PatternMotion, OfAnOrbitLeavesAMarginToItsLimitsForTheHand) {
  Motion motion;
  motion.preset = "orbit";
  motion.target_spread_m = 0;
  // A tenth of each range lies beyond the way on either side, of the azimuth 0.06.
  const auto inside = [](double low, double high, double margin, double value) {
    return value > low + margin * (high - low) && value < high - margin * (high - low);
  };
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random({seed});
    const auto orbit = MakePattern(motion, 1.0, random);
    for (double place = 0; place < 1; place += 0.01) {
      const Eigen::Vector3d ahead = motion.target_w - orbit->At(place, 0.3).camera_w;
      const double distance_m = ahead.norm();
      EXPECT_TRUE(inside(motion.distance_min_m, motion.distance_max_m, 0.099, distance_m));
      const double pitch_rad = std::asin(-ahead.z() / distance_m);
      EXPECT_TRUE(inside(motion.pitch_min_rad, motion.pitch_max_rad, 0.099, pitch_rad));
      const double azimuth_rad = std::atan2(-ahead.x(), ahead.y());
      EXPECT_TRUE(inside(motion.azimuth_min_rad, motion.azimuth_max_rad, 0.059, azimuth_rad));
    }
  }
}

TEST(PatternMotion, LooksAwayToEitherSideInTurn) {
  Motion motion;
  motion.preset = "lookaway";
  motion.target_spread_m = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Random random({seed});
    const auto pattern = MakePattern(motion, 1.0, random);
    double last_deg = 0;
    for (int round = 0; round < 6; ++round) {
      const View view = pattern->At(0.13 * round, round + 0.75);  // amid the second half
      const Eigen::Vector3d ahead = view.gaze_w - view.camera_w;
      const Eigen::Vector3d to_target = motion.target_w - view.camera_w;
      const double off_deg = RadToDeg(
          std::atan2(to_target.cross(ahead).z(), to_target.head<2>().dot(ahead.head<2>())));
      EXPECT_GT(std::abs(off_deg), 100) << seed << " " << round;
      EXPECT_LE(off_deg * last_deg, 0) << seed << ": twice to one side, in round " << round;
      last_deg = off_deg;
    }
  }
}

TEST(PatternMotion, ShakesByTheSeedOfTheRecordingAlone) {
  for (const char* preset : {"xyz", "orbit", "office"}) {
    Scene scene = DeskWith(preset, 1);
    const auto path = MakeTrajectory(scene, 60, kPatternFps, 5);
    scene.seed += 1;
    const auto same = MakeTrajectory(scene, 60, kPatternFps, 5);
    for (std::size_t i = 0; i < path.size(); ++i) {
      ASSERT_EQ(path[i].T_wc.t, same[i].T_wc.t) << preset << " " << i;
      ASSERT_EQ(path[i].T_wc.R, same[i].T_wc.R) << preset << " " << i;
    }
  }
}

TEST(MakeTrajectory, FollowsTheSpeedsThatASceneAsksFor) {
  for (const char* preset : {"office", "xyz", "orbit"}) {
    Scene scene = DeskWith(preset, 2);
    scene.motion.speed_m_s = 0.15;
    scene.motion.turn_deg_s = 10;
    const Means means = MeansOf(MakeTrajectory(scene, kPatternFrames, kPatternFps, 1));
    EXPECT_NEAR(means.speed_m_s, 0.15, 0.15 * 0.15) << preset;
    EXPECT_NEAR(means.turn_deg_s, 10, 0.15 * 10) << preset;
  }
}

TEST(MakeTrajectory, MovesClearOfEveryFamily) {
  for (const Family& family : Families()) {
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      const Scene scene = MakeScene(family.name, seed);
      const auto trajectory = MakeTrajectory(scene, 300, 10, seed);
      EXPECT_GT((trajectory.back().T_wc.t - trajectory.front().T_wc.t).norm(), 0) << seed;
      for (const TimedPose& pose : trajectory) {
        for (const Object& object : scene.objects) {
          ASSERT_GE(DistanceToBox(object, pose.T_wc.t), 0.15)
              << family.name << " " << seed << " " << object.name;
        }
      }
    }
  }
}

TEST(MakeTrajectory, HasTheSpeedsOfEveryTwin) {
  for (const Twin& twin : Twins()) {
    const Scene scene = MakeTwin(twin.name, 1);
    const auto trajectory = MakeTrajectory(scene, scene.capture->frames, scene.capture->fps, 1);
    const Means means = MeansOf(trajectory);
    EXPECT_NEAR(means.speed_m_s, twin.speed_m_s, 0.15 * twin.speed_m_s) << twin.name;
    EXPECT_NEAR(means.turn_deg_s, twin.turn_deg_s, 0.15 * twin.turn_deg_s) << twin.name;
    for (const TimedPose& pose : trajectory) {
      for (const Object& object : scene.objects) {
        ASSERT_GE(DistanceToBox(object, pose.T_wc.t), 0.15) << twin.name << object.name;
      }
    }
  }
}

/// Whether the centre of something but walls and floor is in the picture, at most 4 m away.
bool ShowsFurniture(const Scene& scene, const Pose& T_wc) {
  return std::any_of(scene.objects.begin(), scene.objects.end(), [&](const Object& object) {
    if (object.class_name == "wall" || object.class_name == "floor") return false;
    const Eigen::Vector3d x_c = Inverse(T_wc) * object.center_w;
    return x_c.z() > 0.3 && x_c.z() < 4 && std::abs(x_c.x()) < 0.6 * x_c.z() &&
           std::abs(x_c.y()) < 0.45 * x_c.z();
  });
}

TEST(MakeTrajectory, SeesFurnitureWhereverItLooksInARoom) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Scene scene = MakeTwin("fr1-room", seed);
    for (const TimedPose& pose : MakeTrajectory(scene, 150, 5, seed)) {
      EXPECT_TRUE(ShowsFurniture(scene, pose.T_wc)) << seed << " at " << pose.timestamp_s;
    }
  }
}

TEST(MakeTrajectory, NamesTheWayThatIsNotFree) {
  Scene scene = DeskWith("loop", 1);
  for (int i = 0; i < 4; ++i) {
    scene.motion.stations.push_back({{0.1 * i, 0, 0.1}, {0.1 * i, 1, 0.1}});  // under the desk
  }
  EXPECT_THROW(MakeTrajectory(scene, 10, kPatternFps, 1), io::InputError);
}

TEST(MakeTrajectory, NamesTheWayThatIsBlockedAtAnyOneOfItsPlaces) {
  Scene scene;
  scene.motion.preset = "loop";
  for (int i = 0; i < 8; ++i) {
    const SinCos turn = SinCosDeg(45 * i);
    scene.motion.stations.push_back({{3 * turn.cos, 3 * turn.sin, 1.4}, {0, 0, 0.7}});
  }
  EXPECT_NO_THROW(MakeTrajectory(scene, 10, kPatternFps, 1));
  Random random({1});
  const auto way = MakePattern(scene.motion, 1.0, random);
  scene.objects.emplace_back();
  scene.objects[0].size = {0.1, 0.1, 0.1};
  for (double place = 0; place < 1; place += 0.03) {
    scene.objects[0].center_w = way->At(place, 0).camera_w;
    EXPECT_THROW(MakeTrajectory(scene, 10, kPatternFps, 1), io::InputError) << place;
  }
}

// Recorded baselines stand on these very bits.
TEST(MakeTrajectory, StillGivesTheFirstPresetsBitForBit) {
  struct Golden {
    const char *family, *preset, *hash;
  };
  for (const Golden& golden : {Golden{"desk", "slow", "2ed7d83e396812a4"},
                               {"desk", "office", "6865b2604fcc1b03"},
                               {"desk", "fast", "a782643ed3887152"},
                               {"plates", "slow", "8cb402f9c037bc69"},
                               {"plates", "office", "79277190fbabbd35"},
                               {"stack", "fast", "4c80bc2870cf0933"}}) {
    Scene scene = MakeScene(golden.family, 2);
    scene.motion.preset = golden.preset;
    std::string bytes;
    for (const TimedPose& pose : MakeTrajectory(scene, 90, 30, 5)) {
      for (const double number : pose.T_wc.R.reshaped()) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
      }
      for (const double number : pose.T_wc.t) {
        bytes.append(reinterpret_cast<const char*>(&number), sizeof(number));
      }
    }
    EXPECT_EQ(io::Sha256Hex(bytes).substr(0, 16), golden.hash)
        << golden.family << " " << golden.preset;
  }
}

}  // namespace
}  // namespace sim
