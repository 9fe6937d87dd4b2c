#include "slam/mapping/plane_observation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace slam {
namespace {

/// The part of a wall, 1 m high and 2 m before the camera, between two places along it.
FramePlane PartOfWall(double from_m, double to_m) {
  FramePlane part;
  part.pi_c = {-Eigen::Vector3d::UnitZ(), 2.0};
  part.centroid_c = {0.5 * (from_m + to_m), 0, 2};
  part.offset_sigma_m = 0.001, part.angle_sigma_rad = 0.001;
  for (double x = from_m + 0.0025; x < to_m; x += 0.005)
    for (double y = -0.4975; y < 0.5; y += 0.005) part.points_c.emplace_back(x, y, 2.0);
  return part;
}

TEST(PlaneObservation, AddsToACoarseCloudPointsAsFarApartAsItsOwn) {
  // Of the first part the cloud becomes coarser; the second one at the finest would fit.
  PlaneMapConfig config;
  config.max_cloud_points = 1000;
  Frame frame;
  const FramePlane first = PartOfWall(0.0, 0.6), second = PartOfWall(0.6, 0.8);
  MapPlane wall = StartPlane(first, frame);
  ObservePlane(wall, first, frame, config);
  ASSERT_GT(wall.voxel_m, config.voxel_m);
  const double voxel_m = wall.voxel_m;
  frame.index = 1;
  ObservePlane(wall, second, frame, config);
  EXPECT_EQ(wall.voxel_m, voxel_m);
  const auto in_second = std::count_if(wall.points_w.begin(), wall.points_w.end(),
                                       [](const auto& p_w) { return p_w.x() > 0.6; });
  const auto all = static_cast<double>(wall.points_w.size());
  EXPECT_NEAR(static_cast<double>(in_second) / all, 0.25, 0.04);  // as it has of the area
  EXPECT_NEAR(wall.centroid_w.x(), 0.4, 0.02);
}

}  // namespace
}  // namespace slam
