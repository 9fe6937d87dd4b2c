#include "slam/segment/sight_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Whether the lines between two labels of an image, both of a plane at 1 m, pass behind it.
bool PassBehind(cv::Mat1f depth_m, const LabelImage& labels, std::uint64_t noise_seed = 0,
                double unsure_sigmas = 0.0) {
  Camera camera;
  camera.width = depth_m.cols, camera.height = depth_m.rows;
  if (noise_seed > 0) depth_m = closed_form::AddKinectNoise(depth_m, noise_seed);
  LabelRuns runs;
  FindRuns(labels, depth_m.cols, depth_m.rows, runs);
  std::vector<int> part;
  for (const LabelRun& run : runs.runs) part.push_back(run.label);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), DepthNoise{}, 10.0);
  const LabelPlane plane{InverseDepthPlane{0.0, 0.0, 1.0}, 1.0};
  return SightLines(grid, runs, part, 2).PassBehind(0, 1, plane, unsure_sigmas);
}

/// Two squares of a plane at 1 m, 30 pixels wide and 10 apart, with the ground 10 cm behind all
/// around them. Something `bar_m` away (0 = not measured) stands between them over `bar_rows`
/// of their 30 rows.
bool PassBehindABar(int bar_rows, float bar_m, std::uint64_t noise_seed = 0,
                    double unsure_sigmas = 0.0) {
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
  return PassBehind(depth_m, labels, noise_seed, unsure_sigmas);
}

TEST(SightLines, MayPassAnythingButWhatIsBehind) {
  EXPECT_TRUE(PassBehindABar(40, 1.02f)) << "the ground";
  EXPECT_FALSE(PassBehindABar(40, 0.9f)) << "something in front";
  EXPECT_FALSE(PassBehindABar(40, 1.0f)) << "the plane itself";
  EXPECT_FALSE(PassBehindABar(40, 0.0f)) << "nothing is measured";
}

TEST(SightLines, AreNotDisturbedByNoise) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_TRUE(PassBehindABar(40, 1.02f, seed)) << seed;
    EXPECT_FALSE(PassBehindABar(40, 0.9f, seed)) << seed;
    EXPECT_FALSE(PassBehindABar(40, 1.0f, seed)) << seed;
  }
}

TEST(SightLines, TakeForThePlaneWhatTheSensorMayHaveBent) {
  EXPECT_TRUE(PassBehindABar(40, 1.01f));
  EXPECT_FALSE(PassBehindABar(40, 1.01f, 0, 8.0)) << "10 mm are 5 sigmas";
}

TEST(SightLines, SeeTheGroundBesideWhatStandsBetweenTwoTops) {
  // The bar hides the middle of the gap, and with it the shortest lines.
  for (const int rows : {6, 10}) EXPECT_TRUE(PassBehindABar(rows, 0.9f)) << rows;
}

TEST(SightLines, PassBehindWhateverTheGridMisses) {
  const cv::Mat1f wall(50, 90, 1.0f);
  LabelImage labels(50 * 90, 0);
  labels[9 * 90 + 9] = 1;
  EXPECT_TRUE(PassBehind(wall, labels)) << "a part that nothing is known of";
  labels[16 * 90 + 16] = 1;
  EXPECT_FALSE(PassBehind(wall, labels));
}

/// Parts of a wall at 1 m, and pieces of other depths all over it.
struct BrokenWall {
  static constexpr int kWidth = 120, kHeight = 96;
  cv::Mat1f depth_m = cv::Mat1f(kHeight, kWidth, 1.0f);
  LabelImage labels = LabelImage(kWidth * kHeight, kNoLabel);

  explicit BrokenWall(std::uint64_t seed) {
    Random random{seed};
    const auto piece = [&](float z_m, int label) {
      const int width = 3 + random.Below(40), height = 3 + random.Below(40);
      const int u0 = random.Below(kWidth), v0 = random.Below(kHeight);
      for (int v = v0; v < std::min(v0 + height, kHeight); ++v) {
        for (int u = u0; u < std::min(u0 + width, kWidth); ++u) {
          depth_m(v, u) = z_m;
          labels[static_cast<std::size_t>(v * kWidth + u)] = static_cast<std::int16_t>(label);
        }
      }
    };
    for (int k = 0; k < 5; ++k) piece(1.0f, k % 2);
    for (int k = 0; k < 4; ++k) piece(random.Below(2) == 0 ? 1.1f : 0.9f, kNoLabel);
  }

  int At(int u, int v) const { return labels[static_cast<std::size_t>(v * kWidth + u)]; }
  std::vector<cv::Point> Samples(int label) const {
    std::vector<cv::Point> samples;
    for (int v = 0; v < kHeight; v += 8) {
      for (int u = 0; u < kWidth; u += 8) {
        if (At(u, v) == label) samples.emplace_back(u, v);
      }
    }
    return samples;
  }
  /// Depths on a line; 0 where a part is.
  std::vector<float> Along(const cv::Point& from, const cv::Point& to) const {
    std::vector<float> depths_m;
    const int du = to.x - from.x, dv = to.y - from.y;
    const int steps = std::max(std::abs(du), std::abs(dv));
    for (int s = 1; s < steps; ++s) {
      const int u = from.x + du * s / steps, v = from.y + dv * s / steps;
      depths_m.push_back(At(u, v) == kNoLabel ? depth_m(v, u) : 0.0f);
    }
    return depths_m;
  }
};

/// Of the lines between twelve samples of each, more than a quarter.
bool PlainlyPassBehind(const BrokenWall& wall) {
  const std::vector<cv::Point> a = wall.Samples(0), b = wall.Samples(1);
  if (a.empty() || b.empty()) return true;
  int behind = 0;
  for (std::size_t j = 0; j < 12; ++j) {
    for (std::size_t k = 0; k < 12; ++k) {
      int row = 0, longest = 0;
      for (const float z_m :
           wall.Along(a[a.size() * (2 * j + 1) / 24], b[b.size() * (2 * k + 1) / 24])) {
        row = z_m > 1.05f ? row + 1 : 0;
        longest = std::max(longest, row);
      }
      behind += longest >= 3 ? 1 : 0;
    }
  }
  return 4 * behind > 12 * 12;
}

TEST(SightLines, SayWhatAllTheLinesWouldSay) {
  int pass = 0, do_not = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const BrokenWall wall(seed);
    const bool expected = PlainlyPassBehind(wall);
    EXPECT_EQ(PassBehind(wall.depth_m, wall.labels), expected) << seed;
    ++(expected ? pass : do_not);
  }
  EXPECT_GT(pass, 20);
  EXPECT_GT(do_not, 20);
}

}  // namespace
}  // namespace slam
