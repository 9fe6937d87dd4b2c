#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/stream_run.h"

// Depth that was not measured when its colour was: the stamps say by how much.
namespace slam {
namespace {

constexpr double kLate_s = 0.015;

using Path = Pose (*)(double s);

/// A hand that sets out from rest towards a corner of a room.
Pose HandAt(double s) {
  return {Eigen::Matrix3d::Identity(), {0, 0, -0.12 * (1 - std::cos(2.5 * s))}};
}

/// A hand that is pushed within a frame, and turns back.
Pose PushedAt(double s) {
  const double push = s < 1.0 ? 0.0 : 0.08 * (s - 1.0) * std::exp(-4 * (s - 1.0));
  return {ExpSo3({push, 4 * push, 0}), {push, 0, 0}};
}

std::vector<RecordedFrame> InTheDark(Path T_cw_at, double late_s, bool stamped) {
  const TexturedCorner corner;
  auto frames = SeenStream(kFrames, corner, [=](int i) { return T_cw_at(i / 30.0); });
  const auto later =
      SeenStream(kFrames, corner, [=](int i) { return T_cw_at(i / 30.0 + late_s); });
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].depth_m = later[i].depth_m;
    SetColour(frames[i], cv::Mat1b(frames[i].gray.size(), 0));
    if (stamped) frames[i].depth_late_s = late_s;
  }
  return frames;
}

double RmsError_m(const Ran& ran, Path T_cw_at) {
  EXPECT_GT(ran.outcome.tracked, 45);  // then the floor is out of view
  double sum = 0.0;
  for (std::size_t i = 0; i < ran.poses_wc.size(); ++i) {
    const Pose truth_wc = T_cw_at(0) * Inverse(T_cw_at(static_cast<double>(i) / 30.0));
    sum += (ran.poses_wc[i].second.t - truth_wc.t).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(ran.poses_wc.size()));
}

TEST(LateDepth, IsLaidToItsOwnTimeWhereTheStampsTellIt) {
  // In the dark, where planes alone say where the camera is: at 0.3 m/s 15 ms are 4.5 mm.
  const auto error_m = [](bool stamped) {
    return RmsError_m(RunOn(InTheDark(HandAt, kLate_s, stamped), Variant::kFull), HandAt);
  };
  const double known_m = error_m(true), unknown_m = error_m(false);
  EXPECT_LT(known_m, 0.3 * unknown_m);
  EXPECT_GT(unknown_m, 0.002);
}

TEST(LateDepth, DoesNotMakeAPushSwingOn) {
  // Depth tells where the camera is once its speed is known, and that comes from where it is. Taken
  // one after the other, an error of the speed would come back turned round and larger.
  for (const double late_s : {0.015, 0.025, 0.032}) {
    const Ran ran = RunOn(InTheDark(PushedAt, late_s, true), Variant::kFull);
    EXPECT_EQ(ran.outcome.tracked, kFrames) << late_s;
    EXPECT_LT(RmsError_m(ran, PushedAt), 0.003) << late_s;
    double swing_rad = 0.0;
    for (std::size_t i = ran.poses_wc.size() - 10; i < ran.poses_wc.size(); ++i) {
      const Pose step = Inverse(ran.poses_wc[i - 1].second) * ran.poses_wc[i].second;
      swing_rad = std::max(swing_rad, Log(step).tail<3>().norm());
    }
    EXPECT_LT(swing_rad, 0.004) << late_s;
  }
}

/// To and fro before the front wall, 0.3 m/s either way, turning every sixth of a second.
Pose ShakenAt(double s) {
  const double there = std::fmod(std::max(s, 0.0), 1.0 / 3);
  return {Eigen::Matrix3d::Identity(), {0, 0, -0.3 * std::min(there, 1.0 / 3 - there)}};
}

TEST(LateDepth, TellsPlanesByTheSpeedThatPointsHaveFound) {
  // Depth is earlier than colour, so what moved between them is a part of the way from the frame
  // before. By the speed before that, the first of five frames after each turn would be wrong.
  constexpr double kEarly_s = 0.02, kTurn_mps = 0.6;
  const TexturedCorner corner;
  auto frames = SeenStream(kFrames, corner, [](int i) { return ShakenAt(i / 30.0); });
  const auto earlier = SeenStream(
      kFrames, corner, [=](int i) { return ShakenAt(std::max(i / 30.0 - kEarly_s, 0.0)); });
  for (std::size_t i = 1; i < frames.size(); ++i) {
    frames[i].depth_m = earlier[i].depth_m;
    frames[i].depth_late_s = -kEarly_s;
  }
  const Ran ran = RunOn(std::move(frames), Variant::kFull);
  double sum2 = 0.0;
  int seen = 0;
  for (std::size_t i = 10; i < ran.planes.size(); ++i) {
    const auto line = nlohmann::json::parse(ran.planes[i]);
    for (const auto& plane : line.at("planes")) {
      if (plane.at("normal")[2].get<double>() > -0.99) continue;  // not the front wall
      const double true_m = 2.0 + ShakenAt(static_cast<double>(i) / 30.0).t.z();
      sum2 += std::pow(plane.at("d").get<double>() - true_m, 2);
      ++seen;
    }
  }
  ASSERT_GT(seen, 40);
  const double by_last_speed_m = kEarly_s * kTurn_mps / std::sqrt(5.0);
  EXPECT_LT(std::sqrt(sum2 / seen), 0.5 * by_last_speed_m);
}

}  // namespace
}  // namespace slam
