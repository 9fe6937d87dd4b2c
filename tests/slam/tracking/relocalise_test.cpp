#include "slam/tracking/relocalise.h"

#include <gmock/gmock.h>

#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// A place and its double ten metres beside it, which lacks some of its points.
PointWorld TwoLikePlaces(int lacking, bool double_is_newest) {
  PointWorld world = MakePointWorld(1, 120, 9);
  const Keyframe place = world.map.keyframes[0];
  const std::vector<MapPoint> points = world.map.points;
  world.map = {};
  for (const bool is_double : {!double_is_newest, double_is_newest}) {
    const Eigen::Vector3d off_w(is_double ? 10.0 : 0.0, 0, 0);
    Keyframe keyframe;
    keyframe.id = static_cast<int>(world.map.keyframes.size());
    keyframe.T_cw = place.T_cw * Pose{Eigen::Matrix3d::Identity(), -off_w};
    const auto count =
        place.features.size() - static_cast<std::size_t>(is_double ? lacking : 0);
    keyframe.features.assign(place.features.begin(),
                             place.features.begin() + static_cast<std::ptrdiff_t>(count));
    keyframe.map_points.assign(count, kNone);
    world.map.keyframes.push_back(keyframe);
    for (std::size_t f = 0; f < count; ++f) {
      const auto point = static_cast<std::size_t>(place.map_points[f]);
      AddPoint(world.map, points[point].p_w + off_w, keyframe.id, static_cast<int>(f), {});
    }
  }
  for (const MapPoint& point : world.map.points) UpdatePoint(world.map, point.id, {});
  return world;
}

/// Where a camera at the place is found.
std::optional<PlacePose> Found(const PointWorld& world, const Keyframe& seen,
                               const PointSearchConfig& search = {}) {
  Frame frame;
  frame.features = seen.features;
  KeyframeIndex index(Vocabulary::Shipped());
  index.Update(world.map);
  return Relocalise(frame, world.map, index, world.camera, FeatureScale{}, search);
}

TEST(Relocalise, LooksAtNoMoreKeyframesThanItMayTheNewestFirst) {
  const PointWorld unlike = TwoLikePlaces(60, true);
  for (const int keyframes : {1, 2}) {
    PointSearchConfig search;
    search.place.max_keyframes = keyframes;
    const auto found = Found(unlike, unlike.map.keyframes[0], search);
    ASSERT_TRUE(found);
    const Keyframe& place = unlike.map.keyframes[keyframes == 1 ? 1 : 0];
    EXPECT_THAT(found->T_cw, PoseNear(place.T_cw, 1e-3, 1e-3)) << keyframes;
  }
}

TEST(Relocalise, TakesThePlaceThatFitsBestUnlessAnotherFitsNearlyAsWell) {
  for (const bool double_is_newest : {false, true}) {
    const PointWorld unlike = TwoLikePlaces(60, double_is_newest);
    const Keyframe& place = unlike.map.keyframes[double_is_newest ? 0 : 1];
    const auto found = Found(unlike, place);
    ASSERT_TRUE(found) << double_is_newest;
    EXPECT_THAT(found->T_cw, PoseNear(place.T_cw, 1e-3, 1e-3));
    EXPECT_FALSE(Found(TwoLikePlaces(5, double_is_newest), place)) << double_is_newest;
  }
}

}  // namespace
}  // namespace slam
