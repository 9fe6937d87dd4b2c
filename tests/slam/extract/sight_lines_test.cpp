#include "slam/extract/sight_lines.h"

#include <gtest/gtest.h>

#include "slam/base/camera.h"
#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

/// What lines between two labels of an image, both of a plane at 1 m, say.
template <typename Question>
auto Ask(cv::Mat1f depth_m, const LabelImage& labels, std::uint64_t noise_seed,
         const Question& question) {
  Camera camera;
  camera.width = depth_m.cols, camera.height = depth_m.rows;
  if (noise_seed > 0) depth_m = closed_form::AddKinectNoise(depth_m, noise_seed);
  LabelRuns runs;
  FindRuns(labels, depth_m.cols, depth_m.rows, runs);
  std::vector<int> part;
  for (const LabelRun& run : runs.runs) part.push_back(run.label);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), DepthNoise{}, 10.0);
  SightLines lines;
  lines.Begin(grid, runs, part, 2);
  return question(lines, LabelPlane{InverseDepthPlane{0.0, 0.0, 1.0}, 1.0});
}

/// Two parts of a wall at 1 m, with a strip `between_m` away between them (0 = not measured).
double ShareBehindAStrip(float between_m, std::uint64_t noise_seed = 0) {
  cv::Mat1f depth_m(50, 90, 1.0f);
  depth_m(cv::Rect(40, 0, 10, 50)).setTo(between_m);
  LabelImage labels(50 * 90, kNoLabel);
  for (int v = 0; v < 50; ++v) {
    for (int u = 0; u < 90; ++u) {
      if (u < 40 || u >= 50) labels[static_cast<std::size_t>(v * 90 + u)] = u < 40 ? 0 : 1;
    }
  }
  return Ask(depth_m, labels, noise_seed, [](SightLines& lines, const LabelPlane& plane) {
    return lines.ShareBehind(0, 1, plane);
  });
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

/// Two squares of a plane at 1 m, 30 pixels wide and 10 apart, with the ground 10 cm behind all
/// around them. Something `bar_m` away (0 = not measured) stands between them over `bar_rows`
/// of their 30 rows.
bool AreSidesOfABar(int bar_rows, float bar_m, std::uint64_t noise_seed = 0) {
  cv::Mat1f depth_m(50, 90, 1.1f);
  LabelImage labels(50 * 90, kNoLabel);
  for (const int part : {0, 1}) {
    for (int v = 10; v < 40; ++v) {
      for (int u = 10 + 40 * part; u < 40 + 40 * part; ++u) {
        depth_m(v, u) = 1.0f;
        labels[static_cast<std::size_t>(v * 90 + u)] = static_cast<std::int16_t>(part);
      }
    }
  }
  depth_m(cv::Rect(40, 25 - bar_rows / 2, 10, bar_rows)).setTo(bar_m);
  return Ask(depth_m, labels, noise_seed, [](SightLines& lines, const LabelPlane& plane) {
    return lines.AreSidesOfSomethingInFront(0, 1, plane);
  });
}

TEST(SightLines, UniteWhatSomethingInFrontCutsThoughItEndsElsewhere) {
  EXPECT_TRUE(AreSidesOfABar(40, 0.9f));
  for (const std::uint64_t seed : {1u, 2u, 3u}) EXPECT_TRUE(AreSidesOfABar(40, 0.9f, seed));
}

TEST(SightLines, SeeTheGroundBesideWhatStandsBetweenTwoTops) {
  // The bar hides the middle of the gap, and with it the shortest lines.
  for (const int rows : {10, 16}) EXPECT_FALSE(AreSidesOfABar(rows, 0.9f)) << rows;
}

TEST(SightLines, UniteNothingThatNothingInFrontCuts) {
  EXPECT_FALSE(AreSidesOfABar(40, 0.0f)) << "nothing is measured";
  EXPECT_FALSE(AreSidesOfABar(40, 1.0f)) << "the plane itself";
  EXPECT_FALSE(AreSidesOfABar(40, 1.1f)) << "the ground";
}

}  // namespace
}  // namespace slam
