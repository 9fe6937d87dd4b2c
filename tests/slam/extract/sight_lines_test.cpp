#include "slam/extract/sight_lines.h"

#include <gtest/gtest.h>

#include "slam/base/camera.h"
#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

/// Two parts of a wall at 1 m, with a strip `between_m` away between them (0 = not measured).
double ShareBehindAStrip(float between_m, std::uint64_t noise_seed = 0) {
  Camera camera;
  camera.width = 90, camera.height = 50;
  cv::Mat1f depth_m(50, 90, 1.0f);
  depth_m(cv::Rect(40, 0, 10, 50)).setTo(between_m);
  if (noise_seed > 0) depth_m = closed_form::AddKinectNoise(depth_m, noise_seed);
  LabelImage labels(50 * 90, kNoLabel);
  for (int v = 0; v < 50; ++v) {
    for (int u = 0; u < 90; ++u) {
      if (u < 40 || u >= 50) labels[static_cast<std::size_t>(v * 90 + u)] = u < 40 ? 0 : 1;
    }
  }
  LabelRuns runs;
  FindRuns(labels, 90, 50, runs);
  std::vector<int> part;
  for (const LabelRun& run : runs.runs) part.push_back(run.label);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), DepthNoise{}, 10.0);
  SightLines lines;
  lines.Begin(grid, runs, part, 2);
  return lines.ShareBehind(0, 1, {InverseDepthPlane{0.0, 0.0, 1.0}, 1.0});
}

TEST(SightLines, TellWhatIsBehindFromWhatIsInFront) {
  EXPECT_EQ(ShareBehindAStrip(1.02f), 1.0);
  EXPECT_EQ(ShareBehindAStrip(0.98f), 0.0);
}

TEST(SightLines, SayNothingWhereNothingIsMeasured) { EXPECT_EQ(ShareBehindAStrip(0.0f), 0.0); }

TEST(SightLines, TakeAThirdPartOfThePlaneForNeither) {
  // Noise puts half of its pixels a little behind.
  for (const std::uint64_t seed : {1u, 2u, 3u}) EXPECT_LT(ShareBehindAStrip(1.0f, seed), 0.2);
}

}  // namespace
}  // namespace slam
