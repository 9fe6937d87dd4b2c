#include "eval/surfaces/outline.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace eval {
namespace {

TEST(OutlinedSurface, RunsAroundItsCellsInBothDirectionsAlike) {
  Sheet sheet;
  sheet.pi_g = {Eigen::Vector3d::UnitZ(), -3.0};
  sheet.chart_g = {{1, 2, 3}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  sheet.height_m = cv::Mat1d(80, 60, 0.0);
  // Cells of a centimetre, the middle of (0, 0) at (1, 2).
  CellMask mask(80, 60, std::uint8_t(0));
  mask(cv::Rect(10, 20, 20, 30)) = 255;
  mask(cv::Rect(15, 30, 6, 6)) = 0;
  sheet.hits = mask / 255;
  const Surface surface = OutlinedSurface(sheet, mask);
  ASSERT_EQ(surface.outlines.size(), 1u);
  ASSERT_EQ(surface.holes.size(), 1u);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner_m : surface.outlines[0]) box.extend(corner_m);
  constexpr double kQuarter_m = Sheet::kCell_m / 4;
  EXPECT_LT((box.min() - Eigen::Vector2d(0.095, 0.195)).cwiseAbs().maxCoeff(), kQuarter_m);
  EXPECT_LT((box.max() - Eigen::Vector2d(0.295, 0.495)).cwiseAbs().maxCoeff(), kQuarter_m);
  const SurfaceArea area(surface);
  EXPECT_TRUE(area.Holds({1.10, 2.20, 3}));
  EXPECT_TRUE(area.Holds({1.29, 2.49, 3}));
  EXPECT_FALSE(area.Holds({1.08, 2.30, 3}));
  EXPECT_FALSE(area.Holds({1.20, 2.18, 3}));
  EXPECT_FALSE(area.Holds({1.20, 2.51, 3}));
  EXPECT_FALSE(area.Holds({1.175, 2.325, 3})) << "in the hole";
}

TEST(OutlinedSurface, IsAsFlatAsItsCellsAreAboutItsOwnPlane) {
  Sheet sheet;
  sheet.pi_g = {Eigen::Vector3d::UnitZ(), -3.0};
  sheet.chart_g = {{1, 2, 3}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  const CellMask mask(40, 60, std::uint8_t(255));
  sheet.hits = cv::Mat1i(mask.size(), 1);
  const auto height_m = [](double u, double v) { return 0.010 + 0.02 * u - 0.01 * v; };
  for (const double ripple_m : {0.0, 0.001}) {
    sheet.height_m = cv::Mat1d(mask.size());
    for (int v = 0; v < mask.rows; ++v) {
      for (int u = 0; u < mask.cols; ++u) {  // up and down by turns, so that no plane follows
        sheet.height_m(v, u) = height_m(u * Sheet::kCell_m, v * Sheet::kCell_m) +
                               ((u + v) % 2 == 0 ? ripple_m : -ripple_m);
      }
    }
    const Surface surface = OutlinedSurface(sheet, mask);
    EXPECT_NEAR(surface.flatness_m, ripple_m, 1e-6);
    EXPECT_NEAR(SignedDistance(surface.pi_g, {1.3, 2.2, 3 + height_m(0.3, 0.2)}), 0, 1e-9);
  }
}

/// A rectangle in the chart, from its lower corner to its upper one.
Polygon2 RectangleOf(double u0, double v0, double u1, double v1) {
  return {{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}};
}

TEST(SurfaceArea, HoldsAnOutlineThatLiesInAHoleAndNotItsOwnHole) {
  Surface surface;
  surface.chart_g = {{0, 0, 0}, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
  // A picture in its frame on a wall, with a hole: the smaller outline comes first in the file.
  surface.outlines = {RectangleOf(0.3, 0.3, 0.7, 0.7), RectangleOf(0, 0, 1, 1)};
  surface.holes = {RectangleOf(0.45, 0.45, 0.55, 0.55), RectangleOf(0.2, 0.2, 0.8, 0.8)};
  const SurfaceArea area(surface);
  EXPECT_TRUE(area.Holds({0.1, 0.1, 0}));
  EXPECT_FALSE(area.Holds({0.25, 0.25, 0})) << "between wall and picture";
  EXPECT_TRUE(area.Holds({0.4, 0.4, 0})) << "the picture";
  EXPECT_FALSE(area.Holds({0.5, 0.5, 0})) << "the hole in the picture";
}

}  // namespace
}  // namespace eval
