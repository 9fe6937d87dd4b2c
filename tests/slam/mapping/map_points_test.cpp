#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"

#include <gtest/gtest.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

Keyframe& KeyframeAt(Map& map, int id) { return map.keyframes[static_cast<std::size_t>(id)]; }
MapPoint& PointOf(Map& map, int id) { return map.points[static_cast<std::size_t>(id)]; }

/// Both sides must tell the same: a point's observations and its keyframes' slots.
void ExpectConsistent(const Map& map) {
  for (const MapPoint& point : map.points) {
    EXPECT_TRUE(!point.culled || point.observations.empty());
    for (const auto& [keyframe, feature] : point.observations) {
      EXPECT_EQ(map.keyframes.at(static_cast<std::size_t>(keyframe))
                    .map_points.at(static_cast<std::size_t>(feature)),
                point.id);
    }
  }
  for (const Keyframe& keyframe : map.keyframes) {
    for (std::size_t f = 0; f < keyframe.map_points.size(); ++f) {
      const int point = keyframe.map_points[f];
      if (point == kNone) continue;
      const auto& seen = map.points.at(static_cast<std::size_t>(point)).observations;
      ASSERT_TRUE(seen.count(keyframe.id));
      EXPECT_EQ(seen.at(keyframe.id), static_cast<int>(f));
    }
  }
}

TEST(MapPoints, StayConsistentThroughFusionAndRemoval) {
  Map map = MakePointWorld(4, 60, 1).map;
  ExpectConsistent(map);
  ReplacePoint(map, PointAt(map, 0, 3), PointAt(map, 0, 4));
  RemoveObservation(map, PointAt(map, 1, 5), 1);
  CullPoint(map, PointAt(map, 2, 6));
  ExpectConsistent(map);
}

TEST(MapPoints, AreFoundUnderTheirOldNumberAfterFusion) {
  Map map = MakePointWorld(3, 40, 2).map;
  const int a = PointAt(map, 0, 0), b = PointAt(map, 0, 1), c = PointAt(map, 0, 2);
  ReplacePoint(map, a, b);
  ReplacePoint(map, b, c);
  EXPECT_EQ(CurrentPoint(map, a), c);
  EXPECT_EQ(CurrentPoint(map, c), c);
  CullPoint(map, c);
  EXPECT_EQ(CurrentPoint(map, a), kNone);
  EXPECT_EQ(CurrentPoint(map, kNone), kNone);
}

TEST(MapPoints, TakeOverObservationsOfKeyframesThatDoNotSeeThemYet) {
  Map map = MakePointWorld(2, 40, 3).map;
  const int a = PointAt(map, 0, 0), b = PointAt(map, 0, 1);
  const int a_in_1 = PointOf(map, a).observations.at(1);
  RemoveObservation(map, b, 1);
  ASSERT_TRUE(PointOf(map, b).culled);  // one view is not enough
  const int c = PointAt(map, 0, 1);
  PointOf(map, c).observations.erase(1);
  for (int& slot : KeyframeAt(map, 1).map_points) slot = slot == c ? kNone : slot;
  ReplacePoint(map, a, c);
  EXPECT_EQ(PointOf(map, c).observations.at(1), a_in_1);
  EXPECT_EQ(PointOf(map, c).observations.size(), 2u);
}

TEST(MapPoints, AreCulledWhenYoungAndSeldomFound) {
  Map map = MakePointWorld(3, 40, 4).map;
  const int a = PointAt(map, 0, 0), b = PointAt(map, 0, 1);
  PointOf(map, a).visible_count = 10;
  PointOf(map, a).found_count = 2;
  PointOf(map, b).visible_count = 10;
  PointOf(map, b).found_count = 3;
  EXPECT_EQ(CullYoungPoints(map, 2, {}), 1);
  EXPECT_TRUE(PointOf(map, a).culled);
  EXPECT_FALSE(PointOf(map, b).culled);
}

TEST(MapPoints, AreFoundAsOftenAfterFusionAsTheTwoTogetherWere) {
  for (const int found : {1, 4}) {  // of ten frames, besides one of ten by the other
    Map map = MakePointWorld(3, 40, 4).map;
    const int a = PointAt(map, 0, 0), b = PointAt(map, 0, 1);
    PointOf(map, a).visible_count = PointOf(map, b).visible_count = 10;
    PointOf(map, a).found_count = 1;
    PointOf(map, b).found_count = found;
    ReplacePoint(map, a, b);
    EXPECT_EQ(PointOf(map, b).visible_count, 20);
    EXPECT_EQ(PointOf(map, b).found_count, 1 + found);
    // A quarter is asked for.
    CullYoungPoints(map, 2, {});
    EXPECT_EQ(PointOf(map, b).culled, found == 1);
  }
}

TEST(MapPoints, AreYoungUpToTheLastKeyframeOfTheirTrial) {
  const PointCullingConfig config;
  for (const int late : {0, 1}) {
    Map map = MakePointWorld(3, 40, 4).map;
    const int a = PointAt(map, 0, 0);
    PointOf(map, a).visible_count = 10;
    PointOf(map, a).found_count = 2;
    CullYoungPoints(map, PointOf(map, a).first_keyframe + config.trial_keyframes + late,
                    config);
    EXPECT_EQ(PointOf(map, a).culled, late == 0);
  }
}

TEST(MapPoints, AreYoungWhicheverOrderMappingMadeThemIn) {
  // Mapping in a thread of its own makes points of a keyframe after tracking made those of the next.
  Map map = MakePointWorld(3, 40, 4).map;
  const PointCullingConfig config;
  const int a = PointAt(map, 0, 0), last = map.points.back().id;
  ASSERT_LT(a, last);
  PointOf(map, last).first_keyframe = 0;
  PointOf(map, a).first_keyframe = 1;
  PointOf(map, a).visible_count = 10;
  PointOf(map, a).found_count = 2;
  CullYoungPoints(map, 1 + config.trial_keyframes, config);
  EXPECT_TRUE(PointOf(map, a).culled);
}

TEST(MapPoints, AreCulledBesideNewerOnesThatWentBefore) {
  Map map = MakePointWorld(3, 40, 4).map;
  CullPoint(map, map.points.back().id);  // as a fusion does
  const int a = PointAt(map, 0, 0);
  PointOf(map, a).visible_count = 10;
  PointOf(map, a).found_count = 2;
  EXPECT_EQ(CullYoungPoints(map, 2, {}), 1);
  EXPECT_TRUE(PointOf(map, a).culled);
}

TEST(MapPoints, AreKeptWhenOld) {
  Map map = MakePointWorld(3, 40, 5).map;
  for (MapPoint& point : map.points) point.visible_count = 100;
  PointCullingConfig config;
  EXPECT_EQ(CullYoungPoints(map, config.trial_keyframes + 3, config), 0);
}

TEST(MapPoints, LookAtTheMiddleOfTheirViewsAndKnowTheirScales) {
  Map map;
  const Camera camera;
  Random random{9};
  const Descriptor d = AnyDescriptor(random);
  const Eigen::Vector3d p_w(0, 0, 2);
  for (const double x : {-0.5, 0.5}) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(map.keyframes.size());
    keyframe.T_cw.t = {-x, 0, 0};
    PointFeature feature = FeatureOfPoint(p_w, keyframe.T_cw, camera, d, true);
    feature.octave = 2;
    keyframe.features = {feature};
    keyframe.map_points = {kNone};
    map.keyframes.push_back(keyframe);
  }
  const int id = AddPoint(map, p_w, 0, 0, {});
  AddObservation(map, id, 1, 0);
  UpdatePoint(map, id, {});
  const MapPoint& point = PointOf(map, id);
  EXPECT_LT((point.view_w - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
  const double distance = std::sqrt(4.25);
  EXPECT_NEAR(point.max_distance_m, distance * 1.44, 1e-9);
  EXPECT_NEAR(point.min_distance_m, distance * 1.44 / std::pow(1.2, 7), 1e-9);
  EXPECT_EQ(FeatureScale{}.PredictOctave(distance, point.max_distance_m), 2);
}

TEST(MapPoints, KnowTheirViewsFromTurnedCamerasAndTheirScaleFromTheFirst) {
  Map map;
  const Camera camera;
  Random random{9};
  const Descriptor d = AnyDescriptor(random);
  const Eigen::Vector3d p_w(0.3, -0.2, 2.0);
  const std::vector<Eigen::Vector3d> stands_w{{1.0, 0.2, -0.5}, {-0.4, -0.6, 0.3}};
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& stand_w : stands_w) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(map.keyframes.size());
    keyframe.T_cw = Inverse(Pose{ExpSo3({0.1, -0.3, 0.6 * keyframe.id}), stand_w});
    PointFeature feature = FeatureOfPoint(p_w, keyframe.T_cw, camera, d, true);
    feature.octave = 1 + 3 * keyframe.id;
    keyframe.features = {feature};
    keyframe.map_points = {kNone};
    map.keyframes.push_back(keyframe);
    sum += (p_w - stand_w).normalized();
  }
  // The second keyframe made the point; the first was found to see it as well.
  const int id = AddPoint(map, p_w, 1, 0, {});
  AddObservation(map, id, 0, 0);
  UpdatePoint(map, id, {});
  EXPECT_LT((PointOf(map, id).view_w - sum.normalized()).norm(), 1e-12);
  EXPECT_NEAR(PointOf(map, id).max_distance_m, (p_w - stands_w[1]).norm() * std::pow(1.2, 4),
              1e-9);
  // Without the one that made it, the oldest that is left says.
  PointOf(map, id).first_keyframe = 5;
  UpdatePoint(map, id, {});
  EXPECT_NEAR(PointOf(map, id).max_distance_m, (p_w - stands_w[0]).norm() * 1.2, 1e-9);
}

TEST(MapPoints, TakeTheDescriptorNearestToAllOthers) {
  Map map = MakePointWorld(3, 20, 6).map;
  const int id = PointAt(map, 0, 0);
  ASSERT_EQ(PointOf(map, id).observations.size(), 3u);
  const auto feature_of = [&](int keyframe) -> PointFeature& {
    const int f = PointOf(map, id).observations.at(keyframe);
    return KeyframeAt(map, keyframe).features[static_cast<std::size_t>(f)];
  };
  const Descriptor middle = feature_of(0).descriptor;
  feature_of(0).descriptor[0] ^= 0xFF;  // the other two agree
  UpdatePoint(map, id, {});
  EXPECT_EQ(PointOf(map, id).descriptor, middle);
}

}  // namespace
}  // namespace slam
