#include "slam/mapping/local_mapping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>

#include "slam/base/index.h"
#include "slam/model/map_queries.h"
#include "tests/support/point_world.h"

namespace slam {
namespace {

constexpr int kNewest = 5;

/// Six keyframes side by side that see the same points; the newest one is to be mapped.
struct ToBeMapped : PointWorld {
  ToBeMapped() : PointWorld(MakePointWorld(kNewest + 1, 200, 5)) {}

  int Point(int n) const { return PointAt(map, kNewest, n); }
  MapPoint& At(int point) { return map.points[Index(point)]; }
  void MapIt(const MapTurn& turn = AtOnce) { MapLocally(map, kNewest, camera, {}, {}, turn); }
};

TEST(LocalMapping, CullsAYoungPointThatIsSeldomFound) {
  for (const int found : {1, 90}) {
    ToBeMapped world;
    const int point = world.Point(3);
    world.At(point).first_keyframe = kNewest - 1;
    world.At(point).visible_count = 100, world.At(point).found_count = found;
    world.MapIt();
    EXPECT_EQ(world.At(point).culled, found == 1);
  }
}

TEST(LocalMapping, MakesAPointOfFeaturesThatHaveNone) {
  ToBeMapped world;
  const int point = world.Point(3), feature = world.At(point).observations.at(kNewest);
  const Eigen::Vector3d p_w = world.At(point).p_w;
  CullPoint(world.map, point);
  world.MapIt();
  const int made = world.map.keyframes[kNewest].map_points[Index(feature)];
  ASSERT_NE(made, kNone);
  EXPECT_LT((world.At(made).p_w - p_w).norm(), 1e-3);
}

TEST(LocalMapping, MakesOneOfTwoPoints) {
  ToBeMapped world;
  const int point = world.Point(3), feature = world.At(point).observations.at(kNewest);
  RemoveObservation(world.map, point, kNewest);
  const int copy = AddPoint(world.map, world.At(point).p_w, kNewest, feature, {});
  world.MapIt();
  EXPECT_EQ(CurrentPoint(world.map, copy), point);
  EXPECT_EQ(world.map.keyframes[kNewest].map_points[Index(feature)], point);
}

TEST(LocalMapping, AdjustsPosesAndPoints) {
  ToBeMapped world;
  const ToBeMapped truth = world;
  const int point = world.Point(3);
  world.At(point).p_w.x() += 0.004;
  world.map.keyframes[kNewest].T_cw.t.x() += 0.002;
  world.MapIt();
  EXPECT_LT((world.At(point).p_w - truth.map.points[Index(point)].p_w).norm(), 1e-4);
  EXPECT_LT((world.map.keyframes[kNewest].T_cw.t - truth.map.keyframes[kNewest].T_cw.t).norm(),
            1e-4);
}

TEST(LocalMapping, CullsKeyframesThatShowNothingOfTheirOwn) {
  ToBeMapped world;
  world.MapIt();
  const auto culled = std::count_if(world.map.keyframes.begin(), world.map.keyframes.end(),
                                    [](const Keyframe& keyframe) { return keyframe.culled; });
  EXPECT_GT(culled, 0);
}

// Observations come and go while it works: by definition covisible keyframes share points.
TEST(LocalMapping, KnowsWithWhichKeyframesTheNewestSharesHowManyPoints) {
  ToBeMapped world;
  for (const int n : {5, 25, 45}) {  // wrong matches, that the adjustment takes back
    const int feature = world.At(world.Point(n)).observations.at(kNewest);
    world.map.keyframes[kNewest].features[Index(feature)].u_px.x() += 40;
  }
  const int before = world.map.keyframes[kNewest].covisible.at(0);
  world.MapIt();
  std::map<int, int> shared;
  for (const MapPoint& point : world.map.points) {
    if (point.observations.count(kNewest) == 0) continue;
    for (const auto& [keyframe, feature] : point.observations)
      if (keyframe != kNewest) ++shared[keyframe];
  }
  EXPECT_EQ(world.map.keyframes[kNewest].covisible, shared);
  EXPECT_LT(shared.at(0), before) << "nothing was taken back";
}

bool HaveSamePlaces(const Map& a, const Map& b) {
  return a.points.size() == b.points.size() && a.keyframes.size() == b.keyframes.size() &&
         std::equal(a.points.begin(), a.points.end(), b.points.begin(),
                    [](const MapPoint& p, const MapPoint& q) {
                      return p.p_w == q.p_w && p.culled == q.culled &&
                             p.observations == q.observations;
                    }) &&
         std::equal(a.keyframes.begin(), a.keyframes.end(), b.keyframes.begin(),
                    [](const Keyframe& k, const Keyframe& l) {
                      return k.T_cw.t == l.T_cw.t && k.covisible == l.covisible &&
                             k.culled == l.culled;
                    });
}

// Tracking has the map in between.
TEST(LocalMapping, TouchesTheMapInItsTurnsAlone) {
  ToBeMapped world;
  world.At(world.Point(3)).p_w.x() += 0.004;
  CullPoint(world.map, world.Point(8));
  Map left = world.map;
  int turns = 0;
  world.MapIt([&](const std::function<void()>& work) {
    EXPECT_TRUE(HaveSamePlaces(left, world.map)) << "before turn " << turns;
    work();
    left = world.map;
    ++turns;
  });
  EXPECT_TRUE(HaveSamePlaces(left, world.map));
  EXPECT_GT(turns, 3) << "tracking must not wait for all of it";
}

}  // namespace
}  // namespace slam
