#include "slam/model/local_map.h"

#include "slam/features/point_projection.h"

#include <gmock/gmock.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

/// A camera that stands beside the world's origin and is turned against it.
const Pose kTurned_cw{ExpSo3({0.3, -0.8, 0.5}), {0.4, -0.2, 0.7}};

/// A point 3 m down the ray of a pixel that was last seen along a view 20 degrees away.
MapPoint PointOnRay(const Camera& camera, const Eigen::Vector2d& u_px, double view_off_rad) {
  const Eigen::Vector3d p_c = 3.0 * camera.Backproject(u_px, 1.0).normalized();
  const Eigen::Vector3d axis = p_c.cross(Eigen::Vector3d::UnitY()).normalized();
  MapPoint point;
  point.id = 7;
  point.p_w = Inverse(kTurned_cw) * p_c;
  point.view_w = kTurned_cw.R.transpose() * (ExpSo3(view_off_rad * axis) * p_c / 3.0);
  point.max_distance_m = 3.0 * 1.2 * 1.2;  // octave 2 from 3 m
  point.min_distance_m = 1.0;
  return point;
}

TEST(QueryOfAPoint, SaysWhereInWhichOctavesAndHowFarAroundToLook) {
  const Camera camera;
  const Eigen::Vector2d u_px(500, 90);
  PointProjectionConfig config;
  const MapPoint aside = PointOnRay(camera, u_px, 0.35);
  const PointQuery query = QueryOf(aside, kTurned_cw, camera, FeatureScale{}, 3.0, config);
  ASSERT_EQ(query.point, 7);
  EXPECT_LT((query.u_px - u_px).norm(), 1e-9);
  const double z_m = (kTurned_cw * aside.p_w).z();
  EXPECT_NEAR(query.right_u_px, 500 - FeatureScale{}.bf_px_m / z_m, 1e-9);
  EXPECT_EQ(query.min_octave, 1);
  EXPECT_EQ(query.max_octave, 3);
  EXPECT_NEAR(query.radius_px, config.radius_px * 3.0 * 1.44, 1e-9);

  const PointQuery straight =
      QueryOf(PointOnRay(camera, u_px, 0.01), kTurned_cw, camera, FeatureScale{}, 3.0, config);
  EXPECT_NEAR(straight.radius_px, config.straight_radius_px * 3.0 * 1.44, 1e-9);
}

TEST(QueryOfAPoint, IsNoneOutOfTheRangeOfItsScalesByMoreThanTheMargin) {
  const Camera camera;
  const auto found = [&](double min_m, double max_m) {
    MapPoint point = PointOnRay(camera, {200, 300}, 0.1);
    point.min_distance_m = min_m, point.max_distance_m = max_m;
    return QueryOf(point, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point != kNone;
  };
  EXPECT_TRUE(found(3.0 * 1.19, 20.0));  // nearer than its nearest, within the margin
  EXPECT_FALSE(found(3.0 * 1.21, 20.0));
  EXPECT_TRUE(found(1.0, 3.0 / 1.19));
  EXPECT_FALSE(found(1.0, 3.0 / 1.21));
}

TEST(QueryOfAPoint, IsNoneFromBeyondSixtyDegreesOfItsMeanViewAndBehindTheCamera) {
  const Camera camera;
  const auto found = [&](double off_rad) {
    const MapPoint point = PointOnRay(camera, {400, 200}, off_rad);
    return QueryOf(point, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point != kNone;
  };
  EXPECT_TRUE(found(M_PI / 3 - 0.01));
  EXPECT_FALSE(found(M_PI / 3 + 0.01));
  MapPoint behind = PointOnRay(camera, {400, 200}, 0.0);
  behind.p_w = Inverse(kTurned_cw) * Eigen::Vector3d(0, 0, -3);
  EXPECT_EQ(QueryOf(behind, kTurned_cw, camera, FeatureScale{}, 1.0, {}).point, kNone);
}

/// Keyframes that see points: [keyframe] -> ids.
Map MapOfViews(const std::vector<std::vector<int>>& views, int points) {
  Map map;
  map.points.resize(static_cast<std::size_t>(points));
  for (int id = 0; id < points; ++id) map.points[static_cast<std::size_t>(id)].id = id;
  for (std::size_t k = 0; k < views.size(); ++k) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(k);
    keyframe.features.resize(views[k].size());
    keyframe.map_points = views[k];
    for (std::size_t f = 0; f < views[k].size(); ++f) {
      map.points[static_cast<std::size_t>(views[k][f])].observations[keyframe.id] =
          static_cast<int>(f);
    }
    map.keyframes.push_back(keyframe);
  }
  for (int k = 0; k < static_cast<int>(views.size()); ++k) UpdateCovisibility(map, k, {});
  return map;
}

TEST(LocalMap, TakesKeyframesByTheirShareOfTheFramesPointsThenTheirNeighbours) {
  // The frame shares 1 point with keyframe 0, 3 with keyframe 2, none with 1 and 3; keyframe 1
  // is tied to keyframe 2, keyframe 3 to nothing.
  const Map map = MapOfViews({{0, 9}, {4, 5, 6}, {1, 2, 3, 4, 5}, {7}}, 10);
  Frame frame;
  frame.map_points = {0, kNone, 1, 2, 3};
  const LocalMap local = GatherLocalMap(frame, map, 10);
  EXPECT_EQ(local.reference, 2);
  EXPECT_THAT(local.keyframes, ElementsAre(2, 0, 1));
  EXPECT_THAT(local.points, ElementsAre(0, 1, 2, 3, 4, 5, 6, 9));
  EXPECT_THAT(GatherLocalMap(frame, map, 1).keyframes, ElementsAre(2));
}

TEST(LocalMap, FollowsPointsThatWereFusedAndForgetsCulledOnes) {
  Map map = MapOfViews({{0}, {1, 2}}, 4);
  map.points[3].culled = true, map.points[3].replaced_by = 1;
  map.points[0].culled = true;
  Frame frame;
  frame.map_points = {3, 0};
  EXPECT_THAT(GatherLocalMap(frame, map, 10).keyframes, ElementsAre(1));
}

}  // namespace
}  // namespace slam
