#include "eval/surfaces/label_surfaces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "eval/surfaces/sheet.h"

namespace eval {
namespace {

constexpr int kWidth = 160, kHeight = 120;
constexpr double kFocal = 140.0;

cv::Mat2d Rays() {
  cv::Mat2d rays(kHeight, kWidth);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      rays(v, u) = {(u - 0.5 * (kWidth - 1)) / kFocal, (v - 0.5 * (kHeight - 1)) / kFocal};
    }
  }
  return rays;
}

/// A camera at the origin that looks along +z at a wall.
DepthView WallAt(double z_m) {
  DepthView view;
  view.depth_m = cv::Mat1f(kHeight, kWidth, static_cast<float>(z_m));
  return view;
}

/// Part of a wall, x from `left` to `right`.
Surface PartOfAWall(int id, double z_m, double left, double right) {
  Surface surface;
  surface.id = id;
  surface.pi_g = {Eigen::Vector3d(0, 0, -1), z_m};
  surface.chart_g = ChartOf(surface.pi_g, Eigen::Vector3d(0, 0, z_m));
  Polygon2 outline;
  for (const auto& [x, y] : {std::pair(left, -0.3), {right, -0.3}, {right, 0.3}, {left, 0.3}})
    outline.push_back(surface.chart_g({x, y, z_m}));
  surface.outlines = {outline};
  return surface;
}

// What lies nearest to a plane that ends elsewhere is of the next best one.
TEST(SurfaceLabeller, TakesTheNearestOfThePlanesThatReachThere) {
  const cv::Mat2d rays = Rays();
  const double noise_per_m = 0.002;
  for (const bool other_first : {false, true}) {
    SurfaceFile file;
    file.noise_per_m = noise_per_m;
    const Surface here = PartOfAWall(1, 1.003, -0.4, 0.1),
                  there = PartOfAWall(2, 1.0, 0.1, 0.5);
    file.surfaces = other_first ? std::vector{there, here} : std::vector{here, there};
    const cv::Mat1w labels = SurfaceLabeller(file).Label(WallAt(1.0), rays);
    EXPECT_EQ(labels(kHeight / 2, 40), 1) << other_first;
    EXPECT_EQ(labels(kHeight / 2, 120), 2) << other_first;
  }
}

/// A wall through (0, 0, z) that is turned about the vertical.
DepthView TurnedWall(double z_m, double angle_rad, const cv::Mat2d& rays) {
  DepthView view = WallAt(z_m);
  for (int v = 0; v < kHeight; ++v) {
    for (int u = 0; u < kWidth; ++u) {
      view.depth_m(v, u) = float(z_m / (1 - std::tan(angle_rad) * rays(v, u)[0]));
    }
  }
  return view;
}

// A thing's side crosses a surface: near the line in common its points lie on both.
TEST(SurfaceLabeller, LeavesOutEveryPixelOfAFaceThatCrossesTheSurfaceAtASteepAngle) {
  const cv::Mat2d rays = Rays();
  SurfaceFile file;
  file.noise_per_m = 0.002;
  file.surfaces = {PartOfAWall(1, 1.0, -0.4, 0.4)};
  const SurfaceLabeller labeller(file);
  const auto pixels_at = [&](double angle_deg) {
    const DepthView view = TurnedWall(1.0, angle_deg * M_PI / 180, rays);
    return cv::countNonZero(labeller.Label(view, rays));
  };
  EXPECT_GT(pixels_at(10), kHeight) << "as little as a bend turns it";
  EXPECT_EQ(pixels_at(45), 0);
  EXPECT_EQ(pixels_at(-45), 0);
}

// Near views weigh more, and a surfel is as far away as what it is the mean of.
TEST(SurfelCloud, IsAtTheMeanPlaceAndDepthOfItsPointsNearOnesFirst) {
  const cv::Mat2d rays = Rays();
  const auto depth_of = [&](const std::vector<DepthView>& views) {
    SurfelCloud cloud;
    for (const DepthView& view : views)
      cloud.Add(view, rays, FitLocalNormals(view.depth_m, rays, 2), 0.002);
    const std::vector<Surfel> surfels = cloud.Surfels();
    EXPECT_FALSE(surfels.empty());
    double sum_m = 0.0;
    for (const Surfel& surfel : surfels) {
      EXPECT_NEAR(surfel.p_g.z(), 0.5, 1e-5);
      sum_m += surfel.depth_m / static_cast<double>(surfels.size());
    }
    return sum_m;
  };
  DepthView near = WallAt(0.25);  // the same wall from half as far
  near.T_gc.t = {0, 0, 0.25};
  EXPECT_NEAR(depth_of({WallAt(0.5)}), 0.5, 1e-4);
  const double both_m = depth_of({WallAt(0.5), near});
  EXPECT_GT(both_m, 0.25);
  EXPECT_LT(both_m, 0.5);
}

// Rays that pass are counted for a few pixels alone, and stand for all.
TEST(Sheet, CountsAsManyPassesAsPixelsThatLookThrough) {
  PlanePatch patch;
  patch.pi_g = {Eigen::Vector3d(0, 0, -1), 1.0};
  for (double x = -0.3; x <= 0.3; x += 0.005) {
    for (double y = -0.3; y <= 0.3; y += 0.005) {
      Surfel surfel;
      surfel.p_g = {x, y, 1.0};
      patch.surfels.push_back(surfel);
    }
  }
  const cv::Mat2d rays = Rays();
  const DepthView behind = WallAt(2.0);
  for (const int stride : {1, 2}) {
    std::vector<Sheet> sheets{SheetOver(patch)};
    AddToSheets(behind, rays, FitLocalNormals(behind.depth_m, rays, 2), stride, 0.002, sheets);
    MeanOverHits(sheets[0]);
    // 0.6 m at 1 m are 84 pixels each way, and the sheet has a rim.
    const double pixels = cv::sum(sheets[0].passes)[0] * stride * stride;
    const double side_px = kFocal * Sheet::kCell_m * sheets[0].passes.cols;
    EXPECT_NEAR(pixels / (side_px * side_px), 1.0, 0.1) << stride;
    EXPECT_EQ(cv::countNonZero(sheets[0].hits), 0);
  }
}

}  // namespace
}  // namespace eval
