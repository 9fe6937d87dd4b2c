// Polygons of the image by pencil and paper.
#include "sim/truth/polygon.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// A square wall at y = 0 that the camera, a metre before it, sees square on.
ScenePlane Wall(double half_m, const Eigen::Vector3d& middle_w = Eigen::Vector3d::Zero()) {
  ScenePlane plane;
  plane.n_w = {0, -1, 0};
  for (const auto& [x, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    plane.vertices_w.push_back(middle_w + half_m * Eigen::Vector3d(x, 0, z));
  return plane;
}

const Pose kFromAMetre = LookAt({0, -1, 0}, {0, 0, 0});

Polygon Square(double low_x, double low_y, double side) {
  return {{low_x, low_y},
          {low_x + side, low_y},
          {low_x + side, low_y + side},
          {low_x, low_y + side}};
}

/// Lowest and highest corner.
std::pair<Eigen::Vector2d, Eigen::Vector2d> Bounds(const Polygon& polygon) {
  Eigen::Vector2d low = polygon.front(), high = low;
  for (const Eigen::Vector2d& p : polygon) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {low, high};
}

TEST(ProjectedFace, OfAFaceWithinTheImageHasItsSizeTimesFocalLengthOverDistance) {
  const Camera camera = SmallCamera();
  const auto [low, high] = Bounds(ProjectedFace(Wall(0.1), kFromAMetre, camera));
  EXPECT_NEAR(low.x(), camera.cx - 0.1 * camera.fx, 1e-9);
  EXPECT_NEAR(high.x(), camera.cx + 0.1 * camera.fx, 1e-9);
  EXPECT_NEAR(low.y(), camera.cy - 0.1 * camera.fy, 1e-9);
  EXPECT_NEAR(high.y(), camera.cy + 0.1 * camera.fy, 1e-9);
}

TEST(ProjectedFace, OfAFaceAllRoundEndsAtTheFourBordersOfTheImage) {
  const Camera camera = SmallCamera();
  const Polygon all = ProjectedFace(Wall(20), kFromAMetre, camera);
  const auto [low, high] = Bounds(all);
  EXPECT_NEAR((low - Eigen::Vector2d(-0.5, -0.5)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((high - Eigen::Vector2d(camera.width - 0.5, camera.height - 0.5)).norm(), 0.0,
              1e-9);
  EXPECT_NEAR(std::abs(SignedArea(all)), camera.width * camera.height, 1e-6);
}

TEST(ProjectedFace, OfAFaceThatReachesBehindTheCameraGoesOnToTheBorder) {
  // A floor 0.5 m below the camera, from two metres before it to ten behind: its far edge is a
  // quarter of a focal length below the middle of the image, and from there on all is floor.
  const Camera camera = SmallCamera();
  ScenePlane floor;
  floor.n_w = {0, 0, 1};
  floor.vertices_w = {{-20, -11, -0.5}, {20, -11, -0.5}, {20, 1, -0.5}, {-20, 1, -0.5}};
  const Polygon seen = ProjectedFace(floor, kFromAMetre, camera);
  ASSERT_FALSE(seen.empty());
  const auto [low, high] = Bounds(seen);
  EXPECT_NEAR(low.y(), camera.cy + 0.25 * camera.fy, 1e-9);
  EXPECT_NEAR(high.y(), camera.height - 0.5, 1e-9);
  EXPECT_NEAR(low.x(), -0.5, 1e-9);
  EXPECT_NEAR(high.x(), camera.width - 0.5, 1e-9);
}

TEST(ProjectedFace, OfAFaceBesideTheImageOrBehindTheCameraIsEmpty) {
  EXPECT_TRUE(ProjectedFace(Wall(0.1, {5, 0, 0}), kFromAMetre, SmallCamera()).empty());
  EXPECT_TRUE(ProjectedFace(Wall(0.1, {0, 0, 5}), kFromAMetre, SmallCamera()).empty());
  EXPECT_TRUE(ProjectedFace(Wall(0.1, {0, 0, -5}), kFromAMetre, SmallCamera()).empty());
  EXPECT_TRUE(ProjectedFace(Wall(0.1, {0, -3, 0}), kFromAMetre, SmallCamera()).empty());
}

TEST(Overlap, OfSquaresIsTheRectangleThatBothCoverWhicheverWayTheyRun) {
  const Polygon a = Square(0, 0, 10), b = Square(7, 6, 10);
  const Polygon reversed(b.rbegin(), b.rend());
  EXPECT_NEAR(std::abs(SignedArea(Overlap(a, b))), 3 * 4, 1e-12);
  EXPECT_NEAR(std::abs(SignedArea(Overlap(a, reversed))), 3 * 4, 1e-12);
  EXPECT_NEAR(std::abs(SignedArea(Overlap(b, a))), 3 * 4, 1e-12);
  EXPECT_TRUE(Overlap(a, Square(11, 0, 5)).empty());
}

TEST(Closest, OfSquaresApartIsTheGapBetweenTheirCornersAndNothingWhereTheyOverlap) {
  const ClosestPoints apart = Closest(Square(0, 0, 10), Square(13, 14, 10));
  EXPECT_NEAR(apart.distance, 5.0, 1e-12);
  EXPECT_NEAR((apart.on_a - Eigen::Vector2d(10, 10)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((apart.on_b - Eigen::Vector2d(13, 14)).norm(), 0.0, 1e-12);
  const ClosestPoints across = Closest(Square(0, 0, 10), Square(12, 3, 4));  // corner to side
  EXPECT_NEAR(across.distance, 2.0, 1e-12);
  EXPECT_NEAR(across.on_a.x(), 10.0, 1e-12);  // its side, the other's corners
  EXPECT_NEAR(across.on_b.x(), 12.0, 1e-12);
  const ClosestPoints back = Closest(Square(12, 3, 4), Square(0, 0, 10));
  EXPECT_NEAR(back.on_a.x(), 12.0, 1e-12);
  EXPECT_NEAR(back.on_b.x(), 10.0, 1e-12);
  EXPECT_EQ(Closest(Square(0, 0, 10), Square(5, 5, 10)).distance, 0.0);
}

TEST(Closest, OfWhatOverlapsIsTheMiddleOfThatWhateverItsNumberOfCorners) {
  const Polygon square = Square(0, 0, 10);
  const Polygon across{{13, 1}, {13, 13}, {1, 13}};           // beyond x + y = 14
  const Polygon diamond{{5, -2}, {12, 5}, {5, 12}, {-2, 5}};  // cuts off all four corners
  const Polygon round_all{{-20, -20}, {50, -20}, {-20, 50}};  // the whole square is in it
  for (const auto& [a, b, corners, middle] :
       {std::tuple(square, across, 3, Eigen::Vector2d(8, 8)),  // (4, 10), (10, 4), (10, 10)
        {square, diamond, 8, {5, 5}},
        {round_all, square, 4, {5, 5}},
        {square, round_all, 4, {5, 5}}}) {
    SCOPED_TRACE(corners);
    ASSERT_EQ(static_cast<int>(Overlap(a, b).size()), corners);
    const ClosestPoints closest = Closest(a, b);
    EXPECT_EQ(closest.distance, 0.0);
    EXPECT_NEAR((closest.on_a - middle).norm(), 0.0, 1e-12);
    EXPECT_NEAR((closest.on_b - middle).norm(), 0.0, 1e-12);
  }
}

TEST(SignedArea, IsPositiveWhereVIsToTheLeftOfU) {
  const Polygon square = Square(2, 3, 4);
  EXPECT_EQ(SignedArea(square), 16.0);
  EXPECT_EQ(SignedArea(Polygon(square.rbegin(), square.rend())), -16.0);
}

}  // namespace
}  // namespace sim
