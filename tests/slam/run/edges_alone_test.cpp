#include <gmock/gmock.h>

#include "tests/support/plane_world.h"
#include "tests/support/stream_run.h"

// Tops of a desk all face up: in the dark their edges hold what the planes do not.
namespace slam {
namespace {

constexpr int kLight = 20, kAll = 110;

PlaneWorld Desk() {
  PlaneWorld world;
  world.Add({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, "");
  world.Add({0.05, 0.15, 0.05}, {0.16, 0, 0}, {0, 0.12, 0}, "");
  world.Add({-0.35, 0.2, 0.04}, {0.12, 0.03, 0}, {-0.02, 0.09, 0}, "");
  world.Add({0.1, -0.25, 0.06}, {0.15, -0.04, 0}, {0.03, 0.1, 0}, "");
  return world;
}

/// Starts at rest.
Pose HandAt(int i) {
  const double s = i / 30.0;
  return LookAt({-0.1 + 0.15 * std::cos(2 * s), -0.7 + 0.1 * std::cos(s), 0.9}, {0, 0, 0});
}

/// Everything is printed with one pattern, seen from above.
cv::Mat1b PrintOf(const cv::Mat1f& depth_m, const Pose& T_wc, const Camera& camera) {
  constexpr double kTexelsAMetre = 150.0;
  static const cv::Mat1b pattern = BlockPattern(1024, 5);
  cv::Mat2f at(depth_m.size());
  for (int v = 0; v < at.rows; ++v) {
    for (int u = 0; u < at.cols; ++u) {
      const Eigen::Vector3d p_w =
          T_wc * camera.Backproject({u, v}, static_cast<double>(depth_m(v, u)));
      at(v, u) = {static_cast<float>(512 + kTexelsAMetre * p_w.x()),
                  static_cast<float>(512 + kTexelsAMetre * p_w.y())};
    }
  }
  cv::Mat1b print;
  cv::remap(pattern, print, at, cv::noArray(), cv::INTER_LINEAR, cv::BORDER_REFLECT);
  return print;
}

/// A desk whose lamp goes out after `light` frames.
Ran RunIntoTheDark(int light, bool edges_alone) {
  const Camera camera = CameraOfSize(320, 240);
  std::vector<RecordedFrame> stream;
  for (int i = 0; i < kAll; ++i) {
    const cv::Mat1f depth_m = See(Desk(), HandAt(i), camera, {}, Random{1}).frame.depth_m;
    const cv::Mat1b gray =
        i < light ? PrintOf(depth_m, Inverse(HandAt(i)), camera) : cv::Mat1b(depth_m.size(), 0);
    stream.push_back(StreamFrame(i, gray, depth_m));
  }
  RunOptions options;
  options.variant = Variant::kFull;
  options.config.structure.edges_alone = edges_alone;
  return RunStream(std::move(stream), options, camera);
}

double LargestError_m(const Ran& ran) {
  double largest_m = 0.0;
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = static_cast<int>(std::lround((s - 100.0) * 30));
    largest_m = std::max(largest_m, (T_wc.t - (HandAt(0) * Inverse(HandAt(i))).t).norm());
  }
  return largest_m;
}

TEST(EdgesAlone, HoldACameraOverADeskInTheDark) {
  const Ran ran = RunIntoTheDark(kLight, true);
  ASSERT_EQ(ran.states[kLight - 1], "tracking");
  ASSERT_EQ(ran.states[kLight], "planes");
  EXPECT_EQ(ran.outcome.tracked, kAll);
  EXPECT_LT(LargestError_m(ran), 0.02);
}

TEST(EdgesAlone, AreWhatHoldsIt) {
  EXPECT_EQ(RunIntoTheDark(kLight, false).states.back(), "lost");
}

TEST(EdgesAlone, StartAMapInTheDark) {
  const Ran ran = RunIntoTheDark(0, true);
  EXPECT_EQ(ran.outcome.tracked, kAll);
  EXPECT_LT(LargestError_m(ran), 0.02);
}

TEST(EdgesAlone, AreWhatStartsIt) {
  EXPECT_EQ(RunIntoTheDark(0, false).states.back(), "initialising");
}

}  // namespace
}  // namespace slam
