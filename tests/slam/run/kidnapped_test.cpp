#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/support/stream_run.h"

// F12 and F13 of the fault matrix: a camera that is set down elsewhere, or where it looks alike.
namespace slam {
namespace {

constexpr int kTaken = 25, kReturned = 45;

/// The clean stream, but for the frames 25 to 44, of which the camera is elsewhere.
std::vector<RecordedFrame> TakenTo(const std::vector<RecordedFrame>& elsewhere) {
  auto stream = Clean();
  for (std::size_t i = kTaken; i < kReturned; ++i) {
    const double s = stream[i].timestamp_s;
    stream[i] = elsewhere[i - kTaken];
    stream[i].timestamp_s = s;
  }
  return stream;
}

/// What is `left_m` to the left, where the same two walls are printed otherwise.
std::vector<RecordedFrame> SeenFrom(double left_m) {
  const Pose T_moved{Eigen::Matrix3d::Identity(), {-left_m, 0, 0}};
  return SeenStream(kReturned - kTaken, TexturedCorner(),
                    [&](int i) { return SwingingPose(kTaken + i) * Inverse(T_moved); });
}

TEST(FaultStreamF12, AKidnappedCameraIsLostAndFoundWhenItComesBack) {
  // The old map is what it was: nothing was added elsewhere.
  auto shorter = Clean();
  shorter.erase(shorter.begin() + kTaken, shorter.begin() + kReturned);
  const int keyframes = RunOn(shorter).outcome.keyframes;
  // In another room, and so far along the wall that nothing of the map is seen any more.
  for (const auto& elsewhere :
       {CleanStream(20, TexturedCorner(77)), SeenFrom(4), SeenFrom(5)}) {
    const Ran ran = RunOn(TakenTo(elsewhere));
    ExpectNoWrongPose(ran);
    const auto taken = ran.states.begin() + kTaken, returned = ran.states.begin() + kReturned;
    EXPECT_EQ(std::count(taken, returned, "lost"), kReturned - kTaken);
    EXPECT_EQ(std::count(returned, ran.states.end(), "lost"), 0);
    EXPECT_EQ(ran.outcome.keyframes, keyframes);
  }
}

TEST(FaultStreamF12, ACameraThatIsMovedALittleIsWhereItIsOrLost) {
  // Part of the map is still seen: its place can be told at once, but no other place may be.
  for (const double left_m : {0.5, 2.0, 3.0}) {
    SCOPED_TRACE(left_m);
    Ran ran = RunOn(TakenTo(SeenFrom(left_m)), Variant::kFull);
    EXPECT_EQ(ran.states.back(), "tracking");
    for (auto& [s, T_wc] : ran.poses_wc) {
      const int i = static_cast<int>(std::lround((s - 100.0) * 30));
      if (i >= kTaken && i < kReturned) T_wc.t.x() += left_m;
    }
    ExpectNoWrongPose(ran);
  }
}

// A room of wallpaper, repeated every 0.91 m: a lost camera sees what fits in several places.
constexpr int kRepeat_texels = 64;
constexpr double kRepeat_m = kRepeat_texels / 70.0;

TEST(FaultStreamF13, AmongLookAlikesACameraThatIsFollowedIsNotLost) {
  const Ran ran = RunOn(CleanStream(kFrames, TexturedCorner(1, kRepeat_texels)));
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  ExpectNoWrongPose(ran);
}

TEST(FaultStreamF13, SetDownInALookAlikePlaceBehindACoveredLensItSaysLost) {
  const TexturedCorner world(1, kRepeat_texels);
  constexpr int kUntil = 40;
  const auto stream = CleanStream(kUntil, world);
  for (const Eigen::Vector3d& repeats :
       {Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(-2, 0, 0), Eigen::Vector3d(0, -1, 0)}) {
    SCOPED_TRACE(testing::Message() << repeats.transpose() << " repeats away");
    const Pose T_moved{Eigen::Matrix3d::Identity(), kRepeat_m * repeats};
    auto moved = stream;
    for (int i = 20; i < kUntil; ++i) {
      RecordedFrame& frame = moved[static_cast<std::size_t>(i)];
      const Frame seen =
          world.See(CameraOfSize(320, 240), SwingingPose(i) * Inverse(T_moved), i);
      frame.depth_m = seen.depth_m;
      SetColour(frame, i < 25 ? cv::Mat1b(seen.gray.size(), 0) : seen.gray);
    }
    const Ran ran = RunOn(moved);
    EXPECT_EQ(std::count(ran.states.begin() + 20, ran.states.begin() + 25, "lost"), 5);
    int wrong = 0, found = 0;
    for (const auto& [s, T_wc] : ran.poses_wc) {
      if (s < 100.0 + 24.5 / 30) continue;
      ++found;
      // In the world of the first frame, whose camera stands upright at the origin.
      const Pose truth{TruePoseAt(s).R, TruePoseAt(s).t + T_moved.t};
      wrong += (T_wc.t - truth.t).norm() > kPosition_m;
    }
    EXPECT_EQ(wrong, 0) << "of " << found << " found, " << kUntil - 25 << " looked for";
  }
}

}  // namespace
}  // namespace slam
