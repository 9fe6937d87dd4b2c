#include "slam/tracking/map_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace slam {
namespace {

/// A map with landmarks 0 to 3 and a keyframe for each list, which shows these.
Map MapWith(const std::vector<std::vector<int>>& shown) {
  Map map;
  for (int id = 0; id < 4; ++id) {
    MapPlane plane;
    plane.status = LandmarkStatus::kLandmark;
    map.planes.Add(plane);
  }
  for (const std::vector<int>& ids : shown) {
    Keyframe& keyframe = map.keyframes.emplace_back();
    keyframe.id = static_cast<int>(map.keyframes.size()) - 1;
    for (const int id : ids) keyframe.planes.emplace_back().map_plane = id;
  }
  return map;
}

Frame Showing(const std::vector<int>& ids) {
  Frame frame;
  for (const int id : ids) {
    frame.plane_matches.push_back(
        {id == kNone ? PlaneDecision::kUnmatched : PlaneDecision::kMatched, id});
  }
  return frame;
}

TEST(KeyframeByPlanes, IsTheOldestOfThoseThatShareTheMostLandmarks) {
  Map map = MapWith({{0}, {0, 1, kNone}, {1, 0}, {0, 1, 2}, {3}});
  EXPECT_EQ(KeyframeByPlanes(Showing({0, 1}), map), 1);
  EXPECT_EQ(KeyframeByPlanes(Showing({0, kNone}), map), 0);
  EXPECT_EQ(KeyframeByPlanes(Showing({2, 1, 0}), map), 3);
  EXPECT_EQ(KeyframeByPlanes(Showing({kNone}), map), kNone);
  map.keyframes[1].culled = true;
  EXPECT_EQ(KeyframeByPlanes(Showing({0, 1}), map), 2);
}

TEST(KeyframeByPlanes, KnowsALandmarkByWhatItHasBecome) {
  Map map = MapWith({{0}, {1}});
  map.planes.At(1).status = LandmarkStatus::kMerged;
  map.planes.At(1).merged_into = 2;
  EXPECT_EQ(KeyframeByPlanes(Showing({2}), map), 1);
  EXPECT_EQ(KeyframeByPlanes(Showing({1}), map), 1);
}

TEST(MapCovariance, IsThatOfItsKeyframeSeenFromWhereTheFrameIs) {
  // The keyframe is uncertain about its optical axis; a camera two metres beside it goes up and down
  // with that, by 20 mm for each hundredth of a radian.
  Map map = MapWith({{}});
  map.keyframes[0].T_cw = Pose{ExpSo3({0.4, 0.2, -0.7}), {1, 2, 3}};
  map.keyframes[0].covariance(5, 5) = 1e-4;
  const Pose T_cw = Pose{Eigen::Matrix3d::Identity(), {-2, 0, 0}} * map.keyframes[0].T_cw;
  Matrix6d expected = Matrix6d::Zero();
  expected(1, 1) = 4e-4, expected(5, 5) = 1e-4;
  expected(1, 5) = expected(5, 1) = 2e-4;
  const Matrix6d told = MapCovarianceAt(T_cw, map, 0);
  EXPECT_LT((told - expected).cwiseAbs().maxCoeff(), 1e-12) << told;
}

TEST(MapCovariance, TurnsWithTheCamera) {
  // What the keyframe does not know lies along its x; a camera rolled by 30 degrees has x_k there.
  Map map = MapWith({{}});
  map.keyframes[0].T_cw = Pose{ExpSo3({0.4, 0.2, -0.7}), {1, 2, 3}};
  map.keyframes[0].covariance(0, 0) = 1e-4;
  const Pose T_ck{ExpSo3({0, 0, 0.5236}), Eigen::Vector3d::Zero()};
  const Eigen::Vector3d x_k = T_ck.R * Eigen::Vector3d::UnitX();
  const Matrix6d told = MapCovarianceAt(T_ck * map.keyframes[0].T_cw, map, 0);
  const Eigen::Matrix3d place = told.topLeftCorner<3, 3>();
  EXPECT_LT((place - 1e-4 * x_k * x_k.transpose()).cwiseAbs().maxCoeff(), 1e-12) << told;
}

/// A floor below and a wall ahead, in camera axes, known in the world as well as is said.
std::vector<PlaneConstraint> FloorAndWall(double floor_m, double wall_m) {
  PlaneConstraint floor, wall;
  floor.pi_c = {{0, -1, 0}, 1.2};
  floor.centroid_c = {0, 1.2, 2};
  floor.world_variance_m2 = floor_m * floor_m;
  wall.pi_c = {{0, 0, -1}, 3};
  wall.centroid_c = {0, 0, 3};
  wall.world_variance_m2 = wall_m * wall_m;
  return {floor, wall};
}

TEST(MapCovarianceByPlanes, IsAlongEachStepThatOfThePlaneWhichTellsIt) {
  const Map map = MapWith({{0}});
  const Matrix6d told = MapCovarianceByPlanes(Showing({0}), map, FloorAndWall(0.3, 0.02));
  Matrix6d expected = Matrix6d::Zero();
  expected(1, 1) = 0.09, expected(2, 2) = 4e-4;  // nothing tells the step to the side
  EXPECT_LT((told - expected).cwiseAbs().maxCoeff(), 1e-12) << told;
}

TEST(MapCovarianceByPlanes, IsTheMeanOfTwoThatTellOneStepByTheirWeights) {
  std::vector<PlaneConstraint> planes = FloorAndWall(0.3, 0.02);
  planes.push_back(planes[0]);
  planes[2].world_variance_m2 = 0.0;
  planes[2].offset_sigma_m = planes[0].offset_sigma_m / 3;
  const Matrix6d told = MapCovarianceByPlanes(Showing({0}), MapWith({{0}}), planes);
  EXPECT_NEAR(told(1, 1), 0.1 * 0.09, 1e-12);
}

TEST(MapCovarianceByPlanes, HasWhatTheOldestKeyframeKnowsNoBetter) {
  Map map = MapWith({{0}, {0}});
  map.keyframes[0].covariance(1, 1) = 0.04;
  const Matrix6d lower = MapCovarianceByPlanes(Showing({0}), map, FloorAndWall(0.3, 0.02));
  EXPECT_NEAR(lower(1, 1), 0.09, 1e-12);
  const Matrix6d as_keyframe =
      MapCovarianceByPlanes(Showing({0}), map, FloorAndWall(0.1, 0.02));
  EXPECT_NEAR(as_keyframe(1, 1), 0.04, 1e-12);
}

}  // namespace
}  // namespace slam
