#include "slam/mapping/plane_cloud.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slam {
namespace {

TEST(PlaneCloud, OverlapsWhereItLiesAndNotWhereItIsOfOneShape) {
  const Plane pi_w{Eigen::Vector3d(0.6, 0, 0.8), 0.0};
  const auto patch = [&](double along_m, int cells) {
    std::vector<Eigen::Vector3d> points;
    for (int x = 0; x < cells; ++x) {
      for (int y = 0; y < 10; ++y) {
        points.push_back(Eigen::Vector3d(0.8, 0, -0.6) * (along_m + 0.05 * x) +
                         Eigen::Vector3d(0, 0.05 * y, 0));
      }
    }
    return points;
  };
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(0, 10), pi_w, 0.05, 0), 1.0);
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(2, 10), pi_w, 0.05, 0), 0.0);
  // The last five rows of the one are the first of the other, or the whole of it.
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(0.25, 10), pi_w, 0.05, 0), 0.5);
  EXPECT_EQ(CloudOverlap(patch(0.25, 5), patch(0, 10), pi_w, 0.05, 0), 1.0);
}

TEST(PlaneCloud, OutlineOfASquareHasItsArea) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x <= 10; ++x) {
    for (int y = 0; y <= 10; ++y) points.emplace_back(0.1 * x, 0.1 * y, 2.0);
  }
  const Outline outline = ConvexOutline(points, {Eigen::Vector3d::UnitZ(), -2.0});
  EXPECT_EQ(outline.hull_w.size(), 4u);
  EXPECT_NEAR(outline.area_m2, 1.0, 1e-12);
  EXPECT_TRUE(ConvexOutline({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {Eigen::Vector3d::UnitZ(), 0})
                  .hull_w.empty());
}

// A pose that went astray puts points far off; a grid of voxels up to there would fill any memory.
TEST(PlaneCloud, BecomesCoarserWherePointsLieFarApartAndKeepsThem) {
  const Plane pi_w{Eigen::Vector3d::UnitZ(), 0.0};
  for (const double far_m : {1e3, 1e6}) {
    std::vector<Eigen::Vector3d> cloud_w;
    const double voxel_m = MergeIntoCloud(cloud_w, {{0, 0, 0}, {far_m, -far_m, 0}}, pi_w,
                                          Eigen::Vector3d::Zero(), 0.02, 1000);
    EXPECT_EQ(cloud_w.size(), 2u);
    const double cells = std::pow(far_m / voxel_m, 2);
    EXPECT_GT(cells, 1e5) << "no coarser than it must be";
    EXPECT_LT(cells, 2e6);
  }
}

TEST(PlaneCloud, SaysHowCoarseItBecameAndIsAsDenseAllOver) {
  const Plane pi_w{Eigen::Vector3d::UnitZ(), 0.0};
  std::vector<Eigen::Vector3d> cloud_w;
  double voxel_m = 0.02;
  // Strips 0.2 m wide, one after another: each makes the cloud coarser or comes to a coarser one.
  for (int strip = 0; strip < 5; ++strip) {
    std::vector<Eigen::Vector3d> points_w;
    for (int x = 0; x < 40; ++x) {
      for (int y = 0; y < 200; ++y)
        points_w.emplace_back(0.2 * strip + 0.005 * x + 0.0025, 0.005 * y + 0.0025, 0.0);
    }
    voxel_m = MergeIntoCloud(cloud_w, points_w, pi_w, Eigen::Vector3d(0, 0, 0), voxel_m, 1000);
  }
  EXPECT_EQ(voxel_m, 0.04);
  EXPECT_EQ(cloud_w.size(), 625u);
  EXPECT_LT((CloudCentroid(cloud_w, pi_w) - Eigen::Vector3d(0.5, 0.5, 0)).norm(), 0.03);
}

}  // namespace
}  // namespace slam
