#include "slam/segment/pixel_area.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/random.h"

namespace slam {
namespace {

const cv::Size kImage(60, 40);

TEST(PixelArea, OfARectangleHasItsPixels) {
  PixelArea area;
  SetRectangle({5, 7, 3, 2}, area);
  EXPECT_EQ(area.Bounds(), cv::Rect(5, 7, 3, 2));
  EXPECT_TRUE(area.Contains({5, 7}));
  EXPECT_TRUE(area.Contains({7, 8}));
  EXPECT_FALSE(area.Contains({8, 8}));
  EXPECT_FALSE(area.Contains({5, 6}));
  EXPECT_FALSE(area.Contains({5, 9}));
}

/// By the definition: within every side, moved by the margin.
bool IsWithin(const std::vector<Eigen::Vector2d>& outline, double margin,
              const Eigen::Vector2d& at) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& p : outline) middle += p / static_cast<double>(outline.size());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d along = (outline[(i + 1) % outline.size()] - outline[i]).normalized();
    Eigen::Vector2d n(along.y(), -along.x());
    if (n.dot(middle - outline[i]) > 0) n = -n;
    if (n.dot(at - outline[i]) > margin) return false;
  }
  return true;
}

TEST(PixelArea, OfAnOutlineHasThePixelsWithinItsSides) {
  Random random{3};
  for (int round = 0; round < 60; ++round) {
    // Corners on an ellipse are convex; it may go over the image's border.
    const double cx = 60.0 * random.Uniform(), cy = 40.0 * random.Uniform();
    const double rx = 5.0 + 30.0 * random.Uniform(), ry = 5.0 + 20.0 * random.Uniform();
    const double turn = round % 2 == 0 ? 1.0 : -1.0, start = 6.0 * random.Uniform();
    const double margin = 8.0 * (random.Uniform() - 0.5);
    std::vector<Eigen::Vector2d> outline;
    for (int k = 0; k < 3 + round % 4; ++k) {
      const double angle = start + turn * 2.0 * M_PI * k / (3 + round % 4);
      outline.emplace_back(cx + rx * std::cos(angle), cy + ry * std::sin(angle));
    }
    PixelArea area;
    SetConvex(outline, margin, kImage, area);
    double low = 1e9, high = -1e9;
    for (const Eigen::Vector2d& p : outline)
      low = std::min(low, p.y()), high = std::max(high, p.y());
    for (int v = 0; v < kImage.height; ++v) {
      // A sharp corner's moved sides meet farther away than the margin: there rows end.
      if (v < low - margin || v > high + margin) continue;
      for (int u = 0; u < kImage.width; ++u)
        ASSERT_EQ(area.Contains({u, v}), IsWithin(outline, margin, Eigen::Vector2d(u, v)))
            << "round " << round << " at " << u << ", " << v;
    }
    EXPECT_EQ(area.Bounds() & cv::Rect({0, 0}, kImage), area.Bounds());
  }
}

TEST(PixelArea, OfNothingIsEmpty) {
  PixelArea area;
  SetConvex({}, 5.0, kImage, area);
  EXPECT_TRUE(area.Bounds().empty());
  SetConvex({{3, 3}, {9, 9}}, 5.0, kImage, area);
  EXPECT_TRUE(area.Bounds().empty());
  SetConvex({{100, 100}, {120, 100}, {110, 120}}, 1.0, kImage, area);
  EXPECT_TRUE(area.Bounds().empty());
  SetConvex({{10, 10}, {14, 10}, {14, 14}, {10, 14}}, -3.0, kImage, area);
  EXPECT_TRUE(area.Bounds().empty());
}

}  // namespace
}  // namespace slam
