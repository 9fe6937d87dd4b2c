#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/stream_run.h"

// Depth that was not measured when its colour was: the stamps say by how much.
namespace slam {
namespace {

constexpr double kLate_s = 0.015;

/// A hand that sets out from rest towards a corner of a room.
Pose HandAt(double s) {
  return {Eigen::Matrix3d::Identity(), {0, 0, -0.12 * (1 - std::cos(2.5 * s))}};
}

std::vector<RecordedFrame> Late(bool stamped) {
  const TexturedCorner corner;
  auto frames = SeenStream(kFrames, corner, [](int i) { return HandAt(i / 30.0); });
  const auto later =
      SeenStream(kFrames, corner, [](int i) { return HandAt(i / 30.0 + kLate_s); });
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].depth_m = later[i].depth_m;
    SetColour(frames[i], cv::Mat1b(frames[i].gray.size(), 0));
    if (stamped) frames[i].depth_late_s = kLate_s;
  }
  return frames;
}

double RmsError_m(const Ran& ran) {
  EXPECT_GT(ran.outcome.tracked, 45);  // then the floor is out of view
  double sum = 0.0;
  for (std::size_t i = 0; i < ran.poses_wc.size(); ++i) {
    const Pose truth_wc = HandAt(0) * Inverse(HandAt(static_cast<double>(i) / 30.0));
    sum += (ran.poses_wc[i].second.t - truth_wc.t).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(ran.poses_wc.size()));
}

TEST(LateDepth, IsLaidToItsOwnTimeWhereTheStampsTellIt) {
  // In the dark, where planes alone say where the camera is: at 0.3 m/s 15 ms are 4.5 mm.
  const double known_m = RmsError_m(RunOn(Late(true), Variant::kFull)),
               unknown_m = RmsError_m(RunOn(Late(false), Variant::kFull));
  EXPECT_LT(known_m, 0.3 * unknown_m);
  EXPECT_GT(unknown_m, 0.002);
}

}  // namespace
}  // namespace slam
