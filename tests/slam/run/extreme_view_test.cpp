#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/stream_run.h"

// F18 of the fault matrix: what a camera sees that is too near to anything, or before too little.
namespace slam {
namespace {

int IndexAt(double s) { return static_cast<int>(std::lround((s - 100.0) * 30)); }

/// Errors of a run's positions along the axes of the first camera, by the frame.
std::vector<std::pair<int, Eigen::Vector3d>> PositionErrors_m(
    const Ran& ran, const std::function<Pose(int)>& T_cw_of) {
  std::vector<std::pair<int, Eigen::Vector3d>> errors_m;
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = IndexAt(s);
    errors_m.emplace_back(i, T_wc.t - (T_cw_of(0) * Inverse(T_cw_of(i))).t);
  }
  return errors_m;
}

/// From a metre before the wall at z = 2 up to 3 cm (frames 40 to 49), and back again.
constexpr int kAtTheWall = 40, kBackOff = 50, kBackAgain = 80;
Pose TouchingTheWall(int i) {
  const int away = i < kAtTheWall ? kAtTheWall - i : std::max(0, i - kBackOff + 1);
  const double near = 0.5 * (1 + std::cos(M_PI * std::min(1.0, away / 30.0)));
  return Inverse(Pose{ExpSo3({0.03 * std::sin(0.1 * i), 0.03 * std::sin(0.07 * i), 0}),
                      {0.05 * std::sin(0.1 * i), 0, 1.0 + 0.97 * near}});
}

TEST(FaultStreamF18, ACameraThatTouchesAWallIsLostAndFoundWhenItBacksOff) {
  const auto stream = SeenStream(90, TexturedCorner(), TouchingTheWall);
  ASSERT_LT(stream[kAtTheWall].depth_m(120, 160), 0.05f);
  // Depth as it is, and of a camera that is blind to what is nearer than 35 cm.
  for (const float blind_m : {0.0f, 0.35f}) {
    SCOPED_TRACE(blind_m);
    const Ran ran = RunOn(
        Changed(stream, 0, 90,
                [&](RecordedFrame& frame) { frame.depth_m.setTo(0, frame.depth_m < blind_m); }),
        Variant::kFull);
    for (int i = kAtTheWall; i < kBackOff; ++i) EXPECT_EQ(ran.states[Index(i)], "lost") << i;
    for (int i = kBackAgain; i < 90; ++i) EXPECT_EQ(ran.states[Index(i)], "tracking") << i;
    for (const auto& [i, error_m] : PositionErrors_m(ran, TouchingTheWall))
      EXPECT_LT(error_m.norm(), kPosition_m) << i;
  }
}

TEST(FaultStreamF18, ACameraInABoxIsLostAndFoundWhenItIsTakenOut) {
  constexpr int kFrom = 12, kCount = 10;
  // Its walls are nearer than any camera measures: nothing, or what an eager one says of them.
  for (const float depth_m : {0.0f, 0.03f}) {
    SCOPED_TRACE(depth_m);
    const Ran ran = RunOn(Changed(CleanStream(30), kFrom, kCount,
                                  [&](RecordedFrame& frame) {
                                    frame.depth_m.setTo(depth_m);
                                    cv::Mat1b dark(frame.gray.size());
                                    Random random{5, static_cast<std::uint64_t>(frame.index)};
                                    for (std::uint8_t& grey : dark)
                                      grey = static_cast<std::uint8_t>(random.Below(4));
                                    SetColour(frame, dark);
                                  }),
                          Variant::kFull);
    for (int i = kFrom; i < kFrom + kCount; ++i) EXPECT_EQ(ran.states[Index(i)], "lost") << i;
    EXPECT_EQ(ran.states[kFrom + kCount], "relocalised");
    EXPECT_EQ(ran.states.back(), "tracking");
    ExpectNoWrongPose(ran);
  }
}

/// So far to the left of the floor and the side wall, and above, that only the wall in front is seen.
Pose BeforeOneWall(int i) {
  return SwingingPose(i) * Inverse(Pose{Eigen::Matrix3d::Identity(), {-5, -5, 0}});
}

constexpr int kWallAlone = 110, kPrinted = 10;

/// The wall's print is seen for the first frames, or not at all.
std::vector<RecordedFrame> BlankWall(int printed) {
  return Changed(
      SeenStream(kWallAlone, TexturedCorner(), BeforeOneWall), printed, kWallAlone - printed,
      [](RecordedFrame& frame) { SetColour(frame, cv::Mat1b(frame.gray.size(), 128)); });
}

TEST(FaultStreamF18, OnePlaneAloneHoldsWithItsPrint) {
  const Ran ran = RunOn(BlankWall(kWallAlone), Variant::kFull);
  EXPECT_EQ(ran.outcome.tracked, kWallAlone);
  for (const auto& [i, error_m] : PositionErrors_m(ran, BeforeOneWall))
    EXPECT_LT(error_m.norm(), kPosition_m) << i;
}

/// Standard deviations of a run's positions along the camera's axes, by the pose.
std::vector<Eigen::Vector3d> PositionSigmas_m(const Ran& ran) {
  std::vector<Eigen::Vector3d> sigmas_m;
  std::istringstream lines(ran.covariance);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    std::array<double, 13> c{};  // the stamp; xx to x turn_z; yy to y turn_z; zz
    for (double& word : c) words >> word;
    sigmas_m.emplace_back(std::sqrt(c[1]), std::sqrt(c[7]), std::sqrt(c[12]));
  }
  return sigmas_m;
}

TEST(FaultStreamF18, OnePlaneAloneWithoutPrintHoldsAcrossItAndSaysHowLittleAlongIt) {
  const Ran ran = RunOn(BlankWall(kPrinted), Variant::kFull);
  EXPECT_EQ(ran.states[kPrinted], "planes");
  EXPECT_EQ(ran.states.back(), "lost");  // motion leads no farther
  const auto errors_m = PositionErrors_m(ran, BeforeOneWall);
  const auto sigmas_m = PositionSigmas_m(ran);
  ASSERT_EQ(sigmas_m.size(), errors_m.size());
  ASSERT_GT(errors_m.size(), Index(kPrinted + 5));
  for (std::size_t at = 1; at < errors_m.size(); ++at) {
    const auto& [i, error_m] = errors_m[at];
    EXPECT_LT(std::abs(error_m.z()), 0.002) << i;
    for (const int along : {0, 1}) {
      EXPECT_LT(std::abs(error_m[along]), 3 * sigmas_m[at][along]) << i;
      if (i > kPrinted) {
        EXPECT_GT(sigmas_m[at][along], sigmas_m[at - 1][along]) << i;
      }
    }
  }
  // The camera's axis has turned from the normal by some degrees: a tenth of it shows across.
  EXPECT_GT(sigmas_m.back().head<2>().minCoeff(), 5 * sigmas_m.back().z());
  // Two steps along the wall, and the turn about its normal.
  EXPECT_EQ(nlohmann::json::parse(ran.planes[kPrinted + 2]).at("degenerate").size(), 3u);
}

TEST(FaultStreamF18, OnePlaneAloneWithoutPrintStartsNoMap) {
  const Ran ran = RunOn(BlankWall(0), Variant::kFull);
  EXPECT_THAT(ran.states, testing::Each("initialising"));
  EXPECT_EQ(ran.outcome.tracked, 0);
}

}  // namespace
}  // namespace slam
