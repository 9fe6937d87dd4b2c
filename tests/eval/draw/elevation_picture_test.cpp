#include "eval/draw/elevation_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

#include "eval/draw/paint.h"

namespace eval {
namespace {

/// A level rectangle at a height, seen so many times.
MapScene::Estimate LevelPlane(int id, double height_m, double half_m, int observations) {
  MapScene::Estimate plane;
  plane.id = id;
  plane.pi_v = {Eigen::Vector3d::UnitZ(), -height_m};
  plane.centre_v = {0, 0, height_m};
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
    plane.hull_v.emplace_back(half_m * x, half_m * y, height_m);
  plane.area_m2 = 4 * half_m * half_m;
  plane.observations = observations;
  return plane;
}

cv::Mat Page(const std::vector<MapScene::Estimate>& planes, double height_px) {
  MapScene scene;
  scene.planes = planes;
  MapScale scale;
  scale.x0_m = -0.5, scale.pixels_per_m = 300;
  const cv::Rect2d panel(20, 40, 300, height_px);
  cv::Mat page(220, 520, CV_8UC3, kWhite);
  PutElevation(page, scene, scale, panel);
  return page;
}

/// What stands to the right of the panel: labels, and lines that lead to them.
cv::Mat Labels(const std::vector<MapScene::Estimate>& planes, double height_px) {
  return Page(planes, height_px).colRange(322, 520).clone();
}

// Where labels of all planes do not fit, those that were seen most often have one.
TEST(ElevationPicture, LabelsThePlanesThatWereSeenMostWhereThereIsRoomForFew) {
  const MapScene::Estimate desk = LevelPlane(1, 0.0, 0.5, 90),
                           seen = LevelPlane(3, 0.06, 0.1, 80),
                           rare = LevelPlane(2, 0.02, 0.1, 10),
                           rarer = LevelPlane(4, 0.04, 0.1, 20);
  constexpr double kRoomForTwo_px = 45, kRoomForAll_px = 150;
  for (const auto& all : {std::vector{desk, rare, rarer, seen}, {rare, seen, desk, rarer}}) {
    EXPECT_EQ(cv::norm(Labels(all, kRoomForTwo_px), Labels({desk, seen}, kRoomForTwo_px)), 0.0);
    EXPECT_GT(cv::norm(Labels(all, kRoomForAll_px), Labels({desk, seen}, kRoomForAll_px)), 0.0);
  }
}

// A plane stands on what is below it, and not on what the base is elsewhere.
TEST(ElevationPicture, TellsTheHeightOverTheBaseBelowThePlaneThoughTheBaseIsTilted) {
  constexpr double kAside_m = 0.4, kTilt_rad = 0.05;
  MapScene::Estimate book = LevelPlane(2, 0.02, 0.05, 50);
  book.centre_v.y() = kAside_m;
  for (Eigen::Vector3d& corner : book.hull_v) corner.y() += kAside_m;
  const MapScene::Estimate level = LevelPlane(1, 0.0, 0.5, 90);
  MapScene::Estimate tilted = level;  // of the same height below the book: 20 mm lower or
  tilted.pi_v.n = {0, std::sin(kTilt_rad), std::cos(kTilt_rad)};  // higher at its own centre
  tilted.pi_v.d = -kAside_m * tilted.pi_v.n.y();
  for (const double sign : {1.0, -1.0}) {
    tilted.pi_v.n.y() *= sign, tilted.pi_v.d *= sign;
    tilted.centre_v.z() = HeightAt(tilted.pi_v, tilted.centre_v);
    ASSERT_NEAR(std::abs(tilted.centre_v.z()), 0.02, 1e-4);
    // Round-off may move an edge by a sixteenth of a pixel.
    EXPECT_LT(cv::norm(Page({tilted, book}, 150), Page({level, book}, 150), cv::NORM_INF), 20);
  }
}

}  // namespace
}  // namespace eval
