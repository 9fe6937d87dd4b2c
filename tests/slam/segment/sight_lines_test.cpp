#include "slam/segment/sight_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

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
    for (const int label : {0, 1})
      labels[static_cast<std::size_t>(label)] = static_cast<std::int16_t>(label);
  }

  int At(int u, int v) const { return labels[static_cast<std::size_t>(v * kWidth + u)]; }
  std::vector<cv::Point> Samples(int label) const {
    std::vector<cv::Point> samples;
    for (int v = 0; v < kHeight; v += 8) {
      for (int u = 0; u < kWidth; u += 8) {
        if (At(u, v) == label) samples.emplace_back(u, v);
      }
    }
    for (int i = 0; samples.empty(); ++i) {
      if (At(i % kWidth, i / kWidth) == label) samples.emplace_back(i % kWidth, i / kWidth);
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

/// Of the pixels on the five shortest of the lines from each sample to the nearest other one.
double PlainShareBehind(const BrokenWall& wall) {
  std::vector<std::pair<int, std::pair<cv::Point, cv::Point>>> lines;
  for (const cv::Point& from : wall.Samples(0)) {
    int least = std::numeric_limits<int>::max();
    cv::Point nearest;
    for (const cv::Point& to : wall.Samples(1)) {
      const int length2 = (to - from).dot(to - from);
      if (length2 < least) least = length2, nearest = to;
    }
    lines.push_back({least, {from, nearest}});
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  lines.resize(std::min<std::size_t>(lines.size(), 5));
  int behind = 0, measured = 0;
  for (const auto& [length2, ends] : lines) {
    for (const float z_m : wall.Along(ends.first, ends.second)) {
      measured += z_m > 0 ? 1 : 0, behind += z_m > 1.05f ? 1 : 0;
    }
  }
  return measured > 0 ? static_cast<double>(behind) / measured : 0.0;
}

/// Of the lines between twelve samples of each.
bool PlainlySidesOfSomethingInFront(const BrokenWall& wall) {
  int in_front = 0, beyond = 0;
  for (std::size_t j = 0; j < 12; ++j) {
    for (std::size_t k = 0; k < 12; ++k) {
      const std::vector<cv::Point> a = wall.Samples(0), b = wall.Samples(1);
      int row = 0, longest = 0, nearer = 0;
      for (const float z_m :
           wall.Along(a[a.size() * (2 * j + 1) / 24], b[b.size() * (2 * k + 1) / 24])) {
        row = z_m > 1.05f ? row + 1 : 0;
        longest = std::max(longest, row);
        nearer += z_m > 0 && z_m < 0.95f ? 1 : 0;
      }
      beyond += longest >= 3 ? 1 : 0;
      in_front += longest < 3 && nearer >= 3 ? 1 : 0;
    }
  }
  return in_front >= 72 && beyond <= 7;
}

TEST(SightLines, SayWhatAllTheLinesWouldSay) {
  int sides = 0, in_part = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const BrokenWall wall(seed);
    const double share =
        Ask(wall.depth_m, wall.labels, 0,
            [](SightLines& lines, const auto& p) { return lines.ShareBehind(0, 1, p); });
    const bool is_side =
        Ask(wall.depth_m, wall.labels, 0, [](SightLines& lines, const auto& p) {
          return lines.AreSidesOfSomethingInFront(0, 1, p);
        });
    EXPECT_DOUBLE_EQ(share, PlainShareBehind(wall)) << seed;
    EXPECT_EQ(is_side, PlainlySidesOfSomethingInFront(wall)) << seed;
    in_part += share > 0.0 && share < 1.0 ? 1 : 0, sides += is_side ? 1 : 0;
  }
  EXPECT_GT(in_part, 20);
  EXPECT_GT(sides, 10);
}

}  // namespace
}  // namespace slam
