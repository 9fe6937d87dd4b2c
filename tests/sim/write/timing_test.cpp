#include "sim/write/timing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace sim {
namespace {

// Halfway between two poses: half the way, half the turn.
TEST(PoseBetweenFrames, IsAStraightWayAndASteadyTurn) {
  std::vector<TimedPose> path(2);
  path[0].timestamp_s = 1.0;
  path[1].timestamp_s = 1.5;
  path[1].T_wc.t = {0.2, 0, 0.4};
  path[1].T_wc.R = Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto expect = [&](double time_s, double share) {
    const Pose T = PoseAt(path, time_s);
    const Eigen::Matrix3d R =
        Eigen::AngleAxisd(0.3 * share, Eigen::Vector3d::UnitY()).toRotationMatrix();
    EXPECT_NEAR((T.R - R).norm(), 0, 1e-12);
    EXPECT_NEAR((T.t - share * path[1].T_wc.t).norm(), 0, 1e-12);
  };
  expect(1.0, 0.0);
  expect(1.25, 0.5);
  expect(1.4, 0.8);
  expect(1.6, 1.2);  // goes on as it went
  expect(0.95, -0.1);
}

std::vector<TimedPose> SteadyPath(int frames) {
  std::vector<TimedPose> path(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    path[static_cast<std::size_t>(i)].timestamp_s = i / 30.0;
    path[static_cast<std::size_t>(i)].T_wc.t = {0.3 * i / 30.0, 0, 0};
  }
  return path;
}

TEST(Shots, RepeatTheFrameBeforeAndTellItsPose) {
  const auto shots = MakeShots(SteadyPath(20000), {.drop_ratio = 0.1, .repeat_ratio = 0.02}, 7);
  int repeated = 0;
  EXPECT_EQ(shots[0].exposed, 0);
  for (int i = 1; i < static_cast<int>(shots.size()); ++i) {
    const Shot &shot = shots[static_cast<std::size_t>(i)],
               &before = shots[static_cast<std::size_t>(i - 1)];
    EXPECT_GT(shot.colour_stamp_s, before.colour_stamp_s);
    if (shot.exposed == i) {
      EXPECT_NE(shot.T_wc.t, before.T_wc.t);
      continue;
    }
    ++repeated;
    EXPECT_EQ(shot.exposed, before.exposed);
    EXPECT_EQ(shot.T_wc.t, before.T_wc.t);
  }
  EXPECT_NEAR(repeated / static_cast<double>(shots.size()), 0.02, 0.004);
}

TEST(Shots, AreTheTrajectoryWhenNothingIsWrong) {
  const auto path = SteadyPath(50);
  const auto shots = MakeShots(path, {}, 7);
  ASSERT_EQ(shots.size(), path.size());
  for (std::size_t i = 0; i < path.size(); ++i) {
    EXPECT_EQ(shots[i].time_s, path[i].timestamp_s);
    EXPECT_EQ(shots[i].colour_stamp_s, path[i].timestamp_s);
    EXPECT_EQ(shots[i].depth_stamp_s, path[i].timestamp_s);
    EXPECT_EQ(shots[i].T_wc.t, path[i].T_wc.t);
  }
}

TEST(DroppedFrames, AreTheStatedShareAndNotTheFirst) {
  const auto path = SteadyPath(20000);
  const auto shots = MakeShots(path, {.drop_ratio = 0.04}, 7);
  const double dropped = 1.0 - static_cast<double>(shots.size()) / 20000.0;
  EXPECT_NEAR(dropped, 0.04, 5 * std::sqrt(0.04 * 0.96 / 20000));
  EXPECT_EQ(shots[0].time_s, 0.0);
  std::set<double> times;
  for (const TimedPose& pose : path) times.insert(pose.timestamp_s);
  for (const Shot& shot : shots) EXPECT_TRUE(times.count(shot.time_s));
}

TEST(DroppedFrames, AreTheSameInALongerRecording) {
  const auto few = MakeShots(SteadyPath(100), {.drop_ratio = 0.2}, 3);
  const auto many = MakeShots(SteadyPath(200), {.drop_ratio = 0.2}, 3);
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].time_s, many[i].time_s);
}

TEST(StampJitter, HasTheStatedSdAndKeepsTheOrder) {
  const auto shots = MakeShots(SteadyPath(20000), {.stamp_jitter_s = 0.003}, 9);
  double squares = 0, sum = 0;
  for (const Shot& shot : shots) {
    const double late = shot.colour_stamp_s - shot.time_s;
    sum += late;
    squares += late * late;
    EXPECT_EQ(shot.colour_stamp_s, shot.depth_stamp_s);
  }
  EXPECT_NEAR(std::sqrt(squares / 20000), 0.003, 5 * 0.003 / std::sqrt(40000.0));
  EXPECT_NEAR(sum / 20000, 0, 5 * 0.003 / std::sqrt(20000.0));
  const auto wild = MakeShots(SteadyPath(5000), {.stamp_jitter_s = 0.05}, 9);
  for (std::size_t i = 1; i < wild.size(); ++i) {
    EXPECT_GT(wild[i].colour_stamp_s, wild[i - 1].colour_stamp_s);
  }
}

TEST(DepthOffset, DelaysDepthAndItsStamp) {
  const auto late = MakeShots(SteadyPath(20), {.depth_offset_s = 0.0117}, 1);
  const auto together = MakeShots(SteadyPath(20), {}, 1);
  ASSERT_EQ(late.size(), together.size());
  for (std::size_t i = 0; i < late.size(); ++i) {
    EXPECT_EQ(late[i].colour_stamp_s, together[i].colour_stamp_s);
    EXPECT_NEAR(late[i].depth_stamp_s, together[i].depth_stamp_s + 0.0117, 1e-12);
    EXPECT_NEAR(late[i].DepthDelay_s(), 0.0117, 1e-12);
  }
}

}  // namespace
}  // namespace sim
