#include "slam/tracking/look_alike.h"

#include <gmock/gmock.h>

#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// Looks spread over a wall, and so many of them again a repeat to the right; two metres from
/// a camera that stands far from the world's origin.
struct RepeatingWall {
  static constexpr int kLooks = 40;
  const Eigen::Vector3d repeat_w{0.5, 0.0, 0.0};
  Map map;
  Frame frame;

  /// @param repeated  looks that are found a repeat away; `others` stand where one would be
  RepeatingWall(int repeated, int others) {
    Random random{4};
    const Eigen::Vector3d eye_w(30, -20, 10);
    Keyframe keyframe;
    frame.T_cw = Inverse(Pose{Eigen::Matrix3d::Identity(), eye_w});
    const auto add = [&](const Eigen::Vector3d& p_w, const Descriptor& look) {
      MapPoint point;
      point.id = static_cast<int>(map.points.size());
      point.p_w = p_w;
      point.descriptor = look;
      point.observations[0] = point.id;
      map.points.push_back(point);
      keyframe.map_points.push_back(point.id);
    };
    std::vector<Eigen::Vector3d> places_w;
    for (int i = 0; i < kLooks; ++i) {
      places_w.push_back(eye_w +
                         Eigen::Vector3d(0.13 * (i % 8) - 0.4, 0.13 * (i / 8) - 0.3, 2.0));
      PointFeature feature;
      feature.descriptor = AnyDescriptor(random);
      frame.features.push_back(feature);
      frame.map_points.push_back(i);
      add(places_w.back(), feature.descriptor);
    }
    for (int i = 0; i < repeated + others; ++i) {
      const auto k = static_cast<std::size_t>(i);
      add(places_w[k] + repeat_w + Eigen::Vector3d(0.001 * (i % 2), 0, 0),
          i < repeated ? frame.features[k].descriptor : AnyDescriptor(random));
    }
    keyframe.features.resize(keyframe.map_points.size());
    map.keyframes = {keyframe};
  }
};

TEST(LookAlike, IsARepeatOfThePatternAway) {
  const RepeatingWall wall(40, 0);
  const auto found = FindLookAlike(wall.frame, wall.map, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 40);
  EXPECT_EQ(found->met, 40);
  EXPECT_THAT(found->shift_w, VectorNear(Eigen::Vector3d(0.5005, 0, 0), 1e-9));
}

TEST(LookAlike, IsTheBestOfSeveral) {
  const LookAlikeConfig config;
  for (const bool best_is_left : {false, true}) {
    RepeatingWall wall(best_is_left ? 20 : 40, 0);
    const int more = best_is_left ? 40 : 20;
    for (int i = 0; i < more; ++i) {
      MapPoint point = wall.map.points[static_cast<std::size_t>(i)];
      point.id = static_cast<int>(wall.map.points.size());
      point.p_w.x() -= 1.3;
      point.observations = {{0, point.id}};
      wall.map.points.push_back(point);
      wall.map.keyframes[0].map_points.push_back(point.id);
      wall.map.keyframes[0].features.emplace_back();
    }
    const auto found = FindLookAlike(wall.frame, wall.map, config);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->alike, 40);
    EXPECT_NEAR(found->shift_w.x(), best_is_left ? -1.3 : 0.5005, 1e-3);
  }
}

TEST(LookAlike, IsNoneWhereMostOfWhatStandsThereLooksDifferent) {
  const LookAlikeConfig config;
  EXPECT_TRUE(FindLookAlike(RepeatingWall(15, 15).frame, RepeatingWall(15, 15).map, config));
  EXPECT_FALSE(FindLookAlike(RepeatingWall(10, 30).frame, RepeatingWall(10, 30).map, config));
}

TEST(LookAlike, MayEndWithTheMapButNeedsSomeLikeness) {
  const LookAlikeConfig config;
  const RepeatingWall half(20, 0), few(config.min_alike - 1, 0);
  const auto found = FindLookAlike(half.frame, half.map, config);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->alike, 20);
  // Of the little that stands there everything is alike.
  const RepeatingWall quarter(config.min_alike, 0);
  EXPECT_TRUE(FindLookAlike(quarter.frame, quarter.map, config));
  EXPECT_FALSE(FindLookAlike(few.frame, few.map, config));
  EXPECT_FALSE(FindLookAlike(RepeatingWall(0, 0).frame, RepeatingWall(0, 0).map, config));
}

TEST(LookAlike, IsNotThePlaceItselfFromWhichTwinsOfItsPointsStandALittleOff) {
  // The twins vote for a shift, but within the reach of it are the points themselves, and they look
  // more alike: what is found is the place itself. Farther away the twins are another place.
  const LookAlikeConfig config;
  for (const double off_m : {1.1 * config.min_shift_m, 3.0 * config.min_shift_m}) {
    RepeatingWall wall(0, 0);
    for (int i = 0; i < RepeatingWall::kLooks; ++i) {
      MapPoint twin = wall.map.points[static_cast<std::size_t>(i)];
      twin.id = static_cast<int>(wall.map.points.size());
      twin.p_w.y() += off_m;
      twin.descriptor[0] ^= 0x0F;  // another view of the same print
      twin.observations = {{0, twin.id}};
      wall.map.points.push_back(twin);
      wall.map.keyframes[0].map_points.push_back(twin.id);
      wall.map.keyframes[0].features.emplace_back();
    }
    const auto found = FindLookAlike(wall.frame, wall.map, config);
    EXPECT_EQ(found.has_value(), off_m > 2 * config.min_shift_m) << off_m;
    if (found.has_value()) {
      EXPECT_NEAR(found->shift_w.y(), off_m, 1e-9);
    }
  }
}

}  // namespace
}  // namespace slam
