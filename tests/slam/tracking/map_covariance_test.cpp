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

}  // namespace
}  // namespace slam
