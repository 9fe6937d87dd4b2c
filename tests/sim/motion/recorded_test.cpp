#include "sim/motion/recorded.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/input_error.h"
#include "sim/base/angle.h"
#include "sim/families/families.h"
#include "sim/motion/clearance.h"
#include "sim/motion/trajectory.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace sim {
namespace {

class RecordedTrajectory : public testing::Test {
 protected:
  std::vector<TimedPose> Read(const std::string& text) {
    std::ofstream(path_) << text;
    return ReadTrajectory(path_);
  }
  std::string ErrorOf(const std::string& text) {
    return test_support::RefusalOf([&] { Read(text); });
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path path_ = temporary_ / "trajectory.txt";
};

TEST_F(RecordedTrajectory, StartsTheClockAtTheFirstPose) {
  const auto poses = Read(
      "# a comment\n\n1305031102.5 1 2 3 0 0 0 1\n"
      "1305031103.0\t4 5 6 0 0 0.6 0.8\r\n");
  ASSERT_EQ(poses.size(), 2u);
  EXPECT_EQ(poses[0].timestamp_s, 0);
  EXPECT_EQ(poses[1].timestamp_s, 0.5);
  EXPECT_EQ(poses[1].T_wc.t, Eigen::Vector3d(4, 5, 6));
  EXPECT_NEAR(poses[1].T_wc.R(1, 0), 2 * 0.6 * 0.8, 1e-12);  // z turn: 2 qz qw
}

TEST_F(RecordedTrajectory, NamesTheLineThatIsWrong) {
  const std::string good = "0 0 0 0 0 0 0 1\n";
  for (const char* bad :
       {"1 0 0 0 0 0 0", "1 0 0 0 0 0 0 1 7", "1 0 0 0 0 0 x 1", "1 0 0 0 0 0 0 0.5",
        "1 0 nan 0 0 0 0 1", "0 0 0 0 0 0 0 1", "1 0 0 1e9 0 0 0 1", "1,0,0,0,0,0,0,1"}) {
    EXPECT_NE(ErrorOf(good + bad + "\n").find(".txt:2: "), std::string::npos) << bad;
  }
  EXPECT_NE(ErrorOf(good).find("two poses"), std::string::npos);
  EXPECT_THROW(ReadTrajectory("no/such/file.txt"), io::InputError);
}

TEST_F(RecordedTrajectory, GivesBackAWrittenTrajectory) {
  const auto made = MakeTrajectory(MakeScene("desk", 1), 90, 30, 1);
  std::string text;
  for (const TimedPose& pose : made) {
    const Eigen::Quaterniond q(pose.T_wc.R);
    const Eigen::Vector3d& t = pose.T_wc.t;
    for (const double number :
         {pose.timestamp_s, t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) {
      std::array<char, 40> digits{};
      std::snprintf(digits.data(), digits.size(), "%.9f ", number);
      text += digits.data();
    }
    text += "\n";
  }
  const auto replayed = Replay(Read(text), 90, 30);
  for (std::size_t i = 0; i < made.size(); ++i) {
    EXPECT_LT((replayed[i].T_wc.t - made[i].T_wc.t).norm(), 1e-6);
    EXPECT_LT((replayed[i].T_wc.R - made[i].T_wc.R).norm(), 1e-6);
  }
}

TEST(Replay, GoesHalfWayBetweenTwoPoses) {
  std::vector<TimedPose> poses(2);
  poses[1].timestamp_s = 0.1;
  poses[1].T_wc = {QuaternionFromRpyDeg({0, 0, 10}).toRotationMatrix(), {0.2, 0, 0}};
  const auto at_20 = Replay(poses, 3, 20);
  EXPECT_NEAR(at_20[1].T_wc.t.x(), 0.1, 1e-12);
  EXPECT_NEAR(at_20[1].T_wc.R(1, 0), std::sin(DegToRad(5)), 1e-12);
  EXPECT_NEAR(at_20[2].T_wc.t.x(), 0.2, 1e-12);
}

// A quaternion and its negative are one rotation: cameras that look down pass from one to the other.
TEST(Replay, GoesHalfWayWhereTheQuaternionsSignChanges) {
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(0, 0, -1)}) {
    const auto turned = [&](double deg) {
      return Eigen::AngleAxisd(DegToRad(deg), axis).toRotationMatrix();
    };
    for (const double deg : {120, 180, 240}) {  // at 180 the quaternion's w changes its sign
      std::vector<TimedPose> poses(2);
      poses[0].T_wc.R = turned(deg - 2);
      poses[1].T_wc.R = turned(deg + 2);
      poses[1].timestamp_s = 0.1;
      EXPECT_LT((Replay(poses, 3, 20)[1].T_wc.R - turned(deg)).norm(), 1e-9) << deg;
    }
  }
}

TEST(Replay, RefusesMoreThanWasRecorded) {
  std::vector<TimedPose> poses(3);
  poses[1].timestamp_s = 0.1;
  poses[2].timestamp_s = 0.9;
  EXPECT_THROW(Replay(poses, 31, 30), io::InputError);
  EXPECT_THROW(Replay(poses, 20, 30), io::InputError) << "a hole of 0.8 s";
  EXPECT_EQ(Replay(poses, 4, 30).size(), 4u);
}

std::vector<TimedPose> Through(const Eigen::Vector3d& from_w, const Eigen::Vector3d& to_w) {
  std::vector<TimedPose> trajectory(11);
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const double part = static_cast<double>(i) / 10;
    trajectory[i].timestamp_s = part;
    trajectory[i].T_wc.t = from_w + part * (to_w - from_w);
  }
  return trajectory;
}

Scene OneCarton() {
  Scene scene;
  scene.objects.emplace_back();
  scene.objects[0].name = "carton";
  scene.objects[0].size = {0.4, 0.4, 0.4};
  return scene;
}

TEST(ClearanceWarning, TellsHowNearTheCameraComesAndWhen) {
  const Scene scene = OneCarton();
  EXPECT_EQ(ClearanceWarning(scene, Through({-1, 0.36, 0}, {1, 0.36, 0})), "");
  const auto near = Through({-1, 0.24, 0}, {1, 0.24, 0});
  const NearestPass pass = NearestPassOf(scene, near, PassKind::kBox);
  EXPECT_NEAR(pass.distance_m, 0.04, 1e-12);
  EXPECT_NEAR(pass.timestamp_s, 0.4, 1e-12) << "first of those as near";
  EXPECT_NE(ClearanceWarning(scene, near).find("40 mm from 'carton'"), std::string::npos);
  EXPECT_THROW(ClearanceWarning(scene, Through({-1, 0, 0}, {1, 0, 0})), io::InputError);
}

TEST(ClearanceWarning, RefusesACameraInABoxAlsoWhereABodySurroundsIt) {
  Scene scene = OneCarton();
  scene.objects.push_back(scene.objects[0]);
  scene.objects[1].name = "bush";
  scene.objects[1].shape = ShapeKind::kBush;
  scene.objects[1].size = {3, 3, 3};
  EXPECT_THROW(ClearanceWarning(scene, Through({-1, 0, 0}, {1, 0, 0})), io::InputError);
  EXPECT_NE(ClearanceWarning(scene, Through({-1, 0.24, 0}, {1, 0.24, 0})).find("'carton'"),
            std::string::npos);
  EXPECT_NE(ClearanceWarning(scene, Through({-1, 0.9, 0}, {1, 0.9, 0})).find("'bush'"),
            std::string::npos);
}

TEST(FramesOf, ARecordingThatWasWrittenAreAsManyAsItHas) {
  for (int frames = 2; frames < 200; ++frames) {
    const double last_s = std::round((frames - 1) / 30.0 * 1e6) / 1e6;  // six digits
    EXPECT_EQ(FramesOf({{0, {}}, {last_s, {}}}, 30), frames);
  }
}

TEST(ClearanceWarning, FollowsWhatMoves) {
  Scene scene = OneCarton();
  scene.objects[0].way = {{0, {0, 0, 0}, 0}, {1, {0, 2, 0}, 0}};
  // At 1 s the carton has gone, at 0 s the camera is far.
  EXPECT_EQ(ClearanceWarning(scene, Through({0, -3, 0}, {0, 0, 0})), "");
  EXPECT_THROW(ClearanceWarning(scene, Through({0, 2, 0}, {0, 2, 0})), io::InputError);
}

}  // namespace
}  // namespace sim
