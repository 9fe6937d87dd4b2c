#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "tests/support/stream_run.h"

// Few or no points is a normal state: planes and the camera's own motion carry on.
namespace slam {
namespace {

void Darken(RecordedFrame& frame) { SetColour(frame, cv::Mat1b(frame.gray.size(), 0)); }

void Cover(RecordedFrame& frame) {
  Darken(frame);
  frame.depth_m.setTo(0);
}

/// Leaves of the depth a part of the wall in front.
void LeaveTheWallInFront(RecordedFrame& frame) {
  Darken(frame);
  const cv::Rect wall(20, 20, 220, 140);
  const cv::Mat1f seen = frame.depth_m(wall).clone();
  frame.depth_m.setTo(0);
  seen.copyTo(frame.depth_m(wall));
}

/// The frames from `from` on are those of another stream, at their own times.
std::vector<RecordedFrame> Replaced(std::vector<RecordedFrame> stream, std::size_t from,
                                    const std::vector<RecordedFrame>& other) {
  for (std::size_t i = 0; i < other.size(); ++i) {
    const double s = stream[from + i].timestamp_s;
    stream[from + i] = other[i];
    stream[from + i].timestamp_s = s;
  }
  return stream;
}

std::vector<std::string> StatesOf(const Ran& ran, int from, int count) {
  return {ran.states.begin() + from, ran.states.begin() + from + count};
}

TEST(PlanesAlone, CarryACameraThroughTheDark) {
  const Ran ran = RunOn(Changed(Clean(), 20, 20, Darken), Variant::kFull);
  EXPECT_THAT(StatesOf(ran, 0, 20), testing::Each("tracking"));
  EXPECT_THAT(StatesOf(ran, 20, 20), testing::Each("planes"));
  EXPECT_THAT(StatesOf(ran, 41, 19), testing::Each("tracking"));
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, StartAMapAndFollowIt) {
  const Ran ran = RunOn(Changed(Clean(), 0, kFrames, Darken), Variant::kFull);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  EXPECT_THAT(StatesOf(ran, 1, kFrames - 1), testing::Each("planes"));
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, HandOverToPointsWhenThereIsLight) {
  const Ran ran = RunOn(Changed(Clean(), 0, 20, Darken), Variant::kFull);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  EXPECT_THAT(StatesOf(ran, 25, kFrames - 25), testing::Each("tracking"));
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, SeenByNobodyTheCameraIsLostAtOnce) {
  const Ran ran = RunOn(Changed(Clean(), 20, 10, Cover), Variant::kFull);
  EXPECT_THAT(StatesOf(ran, 20, 10), testing::Each("lost"));
  EXPECT_EQ(ran.states[30], "relocalised");
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, OfOneWallSayWhatTheyDoNotHoldAndGiveUp) {
  const Ran ran = RunOn(Changed(Clean(), 20, 40, LeaveTheWallInFront), Variant::kFull);
  ASSERT_EQ(ran.states[20], "planes");
  // Along the wall, in both directions, and about its normal.
  const auto held = nlohmann::json::parse(ran.planes[20]).at("degenerate");
  ASSERT_EQ(held.size(), 3u);
  EXPECT_NEAR(held[0].at("along").at(2), 0.0, 0.1);
  EXPECT_NEAR(held[1].at("along").at(2), 0.0, 0.1);
  EXPECT_NEAR(std::abs(held[2].at("about").at(2).get<double>()), 1.0, 0.01);
  // A hand goes 10 cm in half a second: after that nobody knows.
  EXPECT_EQ(ran.states[50], "lost");
  ExpectNoWrongPose(ran, 0.1);
}

/// The wall in front and the one at the right: no floor.
void LeaveTwoWalls(RecordedFrame& frame) {
  Darken(frame);
  frame.depth_m.rowRange(150, frame.depth_m.rows).setTo(0);
}

TEST(PlanesAlone, OfTwoWallsLeaveTheHeightToMotionAndGiveUp) {
  // The hand looks half to the right.
  const Pose T_right_c = Inverse(Pose{ExpSo3({0, 0.6, 0}), Eigen::Vector3d::Zero()});
  const auto T_cw_of = [&](int i) { return T_right_c * SwingingPose(i); };
  const auto stream =
      Changed(SeenStream(170, TexturedCorner(), T_cw_of), 20, 150, LeaveTwoWalls);
  RunOptions options;
  options.config.tracking.motion.max_sigma_m = 0.6;
  const Ran ran = RunStream(stream, options);
  ASSERT_EQ(ran.states[19], "tracking");
  ASSERT_EQ(ran.states[20], "planes");
  const auto held = nlohmann::json::parse(ran.planes[22]).at("degenerate");
  ASSERT_EQ(held.size(), 1u);
  EXPECT_NEAR(std::abs(held[0].at("along").at(1).get<double>()), 1.0, 0.01);
  // 30 cm after two seconds, 60 after four.
  EXPECT_EQ(ran.states[110], "planes");
  EXPECT_EQ(ran.states[160], "lost");
  // What the walls tell is right; the height is where motion leads, within what gives it up.
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = static_cast<int>(std::lround((s - 100.0) * 30));
    const Eigen::Vector3d error_m = T_wc.t - (T_cw_of(0) * Inverse(T_cw_of(i))).t;
    EXPECT_LT(std::hypot(error_m.x(), error_m.z()), kPosition_m) << s << " s";
    EXPECT_LT(std::abs(error_m.y()),
              i < 20 ? kPosition_m : options.config.tracking.motion.max_sigma_m)
        << s << " s";
  }
  EXPECT_EQ(RunOn(stream, Variant::kFull).states[160], "planes");  // unless that is too much
}

TEST(PlanesAlone, ThatSeeTheFloorAgainMendTheWayThere) {
  const Pose T_right_c = Inverse(Pose{ExpSo3({0, 0.6, 0}), Eigen::Vector3d::Zero()});
  const auto T_cw_of = [&](int i) { return T_right_c * SwingingPose(i); };
  constexpr int kFrom = 20, kAgain = 80, kAll = 100;
  auto stream = Changed(SeenStream(kAll, TexturedCorner(), T_cw_of), kFrom, kAgain - kFrom,
                        LeaveTwoWalls);
  stream = Changed(stream, kAgain, kAll - kAgain, Darken);
  // How far off the height is at most in these frames.
  const auto largest_m = [&](const Ran& ran, int from, int to) {
    double worst_m = 0.0;
    for (const auto& [s, T_wc] : ran.poses_wc) {
      const int i = static_cast<int>(std::lround((s - 100.0) * 30));
      const Eigen::Vector3d error_m = T_wc.t - (T_cw_of(0) * Inverse(T_cw_of(i))).t;
      if (i >= from && i < to) worst_m = std::max(worst_m, std::abs(error_m.y()));
    }
    return worst_m;
  };
  const Ran mended = RunOn(stream, Variant::kFull);
  EXPECT_EQ(mended.outcome.tracked, kAll);
  stream.resize(kAgain);  // the floor does not come back
  const Ran left = RunOn(stream, Variant::kFull);
  // The last one moves with the keyframe that it is tied to, which is some of the 60 frames older: its
  // variance, growing as their cube, was more than half as large. None is made worse.
  EXPECT_LT(largest_m(mended, kAgain - 1, kAgain), 0.5 * largest_m(left, kAgain - 1, kAgain));
  EXPECT_LE(largest_m(mended, 0, kAgain), largest_m(left, 0, kAgain));
}

/// Standard deviation of the camera's step down in each frame that has a pose, as it was told.
std::vector<double> HeightSigmas_m(const Ran& ran) {
  std::vector<double> sigmas_m;
  std::istringstream lines(ran.covariance);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    double stamp = 0, xx = 0, xy = 0, xz = 0, x = 0, yy = 0;
    words >> stamp >> xx >> xy >> xz >> x >> x >> x >> yy;
    sigmas_m.push_back(std::sqrt(yy));
  }
  return sigmas_m;
}

/// 80 frames in the dark, looking half to the right, of which 45 have no floor.
Ran RunWithoutFloor(int from) {
  const Pose T_right_c = Inverse(Pose{ExpSo3({0, 0.6, 0}), Eigen::Vector3d::Zero()});
  const auto stream =
      SeenStream(80, TexturedCorner(), [&](int i) { return T_right_c * SwingingPose(i); });
  return RunOn(Changed(Changed(stream, 0, 80, Darken), from, 45, LeaveTwoWalls),
               Variant::kFull);
}

TEST(PlanesAlone, MapAFloorNoBetterThanTheHeightWasKnown) {
  const Ran ran = RunWithoutFloor(0);
  ASSERT_EQ(ran.outcome.tracked, 80);
  const auto sigmas_m = HeightSigmas_m(ran);
  ASSERT_GT(sigmas_m[44], 0.15);
  // Nothing comes into view that was seen before the height was lost.
  for (std::size_t i = 45; i < 80; ++i) EXPECT_GT(sigmas_m[i], 0.95 * sigmas_m[44]) << i;
}

TEST(PlanesAlone, KnowTheHeightAgainByAFloorThatWasSeenBeforeItWasLost) {
  const Ran ran = RunWithoutFloor(10);
  ASSERT_EQ(ran.outcome.tracked, 80);
  const auto sigmas_m = HeightSigmas_m(ran);
  ASSERT_GT(sigmas_m[54], 0.15);
  for (std::size_t i = 56; i < 80; ++i) EXPECT_LT(sigmas_m[i], 0.03) << i;
}

TEST(PlanesAlone, DoNotHoldACameraThatIsElsewhere) {
  const Pose T_elsewhere_c{ExpSo3({0, 0.3, 0.1}), {0.3, -0.1, 0.2}};
  const auto elsewhere = SeenStream(20, TexturedCorner(77),
                                    [&](int i) { return T_elsewhere_c * SwingingPose(i); });
  const Ran ran = RunOn(Replaced(Clean(), 25, elsewhere), Variant::kFull);
  EXPECT_THAT(StatesOf(ran, 25, 20), testing::Each("lost"));
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, DoNotHoldACameraThatSeesOtherPrintsWhereTheMapHasPoints) {
  // The walls stand as those of the map do, at the pose that motion predicts.
  const auto repainted =
      SeenStream(20, TexturedCorner(77), [](int i) { return SwingingPose(25 + i); });
  const Ran ran = RunOn(Replaced(Clean(), 25, repainted), Variant::kFull);
  EXPECT_THAT(StatesOf(ran, 25, 20), testing::Each("lost"));
  ExpectNoWrongPose(ran);
}

TEST(PlanesAlone, AreNotAskedWithoutThem) {
  const Ran ran = RunOn(Changed(Clean(), 20, 10, Darken), Variant::kPoints);
  EXPECT_THAT(StatesOf(ran, 20, 10), testing::Each("lost"));
}

}  // namespace
}  // namespace slam
