#include <gmock/gmock.h>

#include "slam/model/map_queries.h"
#include "slam/places/close_loop.h"
#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

constexpr int kMinEdgePoints = 60, kPlenty = 100;
constexpr double kSolved_m = 1e-6;

/// Keyframes on the x axis, a metre apart, that see nothing and share nothing.
Map Line(int count) {
  Map map;
  for (int k = 0; k < count; ++k) {
    Keyframe keyframe;
    keyframe.id = k;
    keyframe.frame_index = 10 * k;
    keyframe.T_cw.t.x() = -k;
    map.keyframes.push_back(keyframe);
  }
  return map;
}

void Share(Map& map, int one, int other, int points) {
  map.keyframes[static_cast<std::size_t>(one)].covisible[other] = points;
  map.keyframes[static_cast<std::size_t>(other)].covisible[one] = points;
}

Map Chain(int count) {
  Map map = Line(count);
  for (int k = 1; k < count; ++k) Share(map, k - 1, k, kPlenty);
  return map;
}

/// The newest keyframe is found to see the place of the first one, from `x_m`.
Loop LoopFrom(const Map& map, double x_m) {
  const Keyframe& newest = map.keyframes.back();
  Loop loop;
  loop.keyframe = newest.id;
  loop.place = 0;
  loop.T_cw.t.x() = -x_m;
  loop.map_points.assign(newest.features.size(), kNone);
  return loop;
}

LoopReport Close(Map& map, const Loop& loop, const LocalMappingConfig& mapping = {},
                 int full_iterations = 0) {
  LoopClosingConfig config;
  config.min_edge_points = kMinEdgePoints;
  config.full_iterations = full_iterations;
  return CloseLoop(map, loop, Camera{}, FeatureScale{}, mapping, config);
}

void ExpectAt(const Map& map, const std::vector<double>& x_m) {
  ASSERT_EQ(map.keyframes.size(), x_m.size());
  for (int k = 0; k < static_cast<int>(x_m.size()); ++k) {
    const Eigen::Vector3d center_w = Inverse(KeyframePose(map, k)).t;
    EXPECT_THAT(center_w,
                VectorNear(Eigen::Vector3d(x_m[static_cast<std::size_t>(k)], 0, 0), kSolved_m))
        << k;
  }
}

// The pose graph is one of equal springs: pencil and paper say where each keyframe comes to rest.

TEST(DrawTogether, KeyframesThatShareEnoughHoldEachOther) {
  Map map = Chain(5);
  Share(map, 1, 3, kMinEdgePoints);
  const LoopReport report = Close(map, LoopFrom(map, 3.45));
  EXPECT_NEAR(report.moved_m, 0.55, 1e-12);
  // A force of 0.15: the middle, two springs beside one, gives way by two thirds of one spring.
  ExpectAt(map, {0, 0.85, 1.8, 2.75, 3.6});
}

TEST(DrawTogether, KeyframesThatShareTooLittleDoNotHoldEachOther) {
  Map map = Chain(5);
  Share(map, 1, 3, kMinEdgePoints - 1);
  Close(map, LoopFrom(map, 3.45));
  ExpectAt(map, {0, 0.89, 1.78, 2.67, 3.56});  // a chain and the loop: five equal springs
}

TEST(DrawTogether, AKeyframeHangsOnTheOlderOneThatSharesMostWithIt) {
  // Keyframe 1 is a side branch: 2 shares more with 0.
  Map map = Line(5);
  Share(map, 0, 1, 20);
  Share(map, 0, 2, 50), Share(map, 1, 2, 20);
  Share(map, 2, 3, 50), Share(map, 3, 4, 50);
  Close(map, LoopFrom(map, 3.6));
  ExpectAt(map, {0, 1.0, 1.9, 2.8, 3.7});
}

TEST(DrawTogether, AKeyframeThatSharesNothingHangsOnTheOneBeforeThatIsLeft) {
  Map map = Line(6);
  Keyframe& culled = map.keyframes[2];
  culled.culled = true;
  culled.parent = 1;
  culled.T_cp.t.x() = -1.0;
  Close(map, LoopFrom(map, 4.5));
  ExpectAt(map, {0, 0.9, 1.9, 2.8, 3.7, 4.6});
}

TEST(DrawTogether, TheWorldStaysThoughTheKeyframeSharesPointsWithTheFirst) {
  Map map = Chain(4);
  Share(map, 0, 3, kPlenty);
  Loop loop = LoopFrom(map, 2.5);
  loop.place = 1;
  Close(map, loop);
  EXPECT_EQ(map.keyframes[0].T_cw.t, Eigen::Vector3d::Zero());
  EXPECT_EQ(map.keyframes[0].T_cw.R, Eigen::Matrix3d::Identity());
}

TEST(DrawTogether, PointsStayWhereTheirKeyframesSawThem) {
  Map map = Chain(5);
  const Eigen::Vector3d p_c(0.3, -0.2, 2.0);
  for (const Keyframe& keyframe : map.keyframes) {
    MapPoint point;
    point.id = point.first_keyframe = keyframe.id;
    point.p_w = Inverse(keyframe.T_cw) * p_c;
    map.points.push_back(point);
  }
  Close(map, LoopFrom(map, 3.5));
  ExpectAt(map, {0, 0.9, 1.8, 2.7, 3.6});
  for (const MapPoint& point : map.points) {
    const Keyframe& keyframe = map.keyframes[static_cast<std::size_t>(point.id)];
    EXPECT_THAT(Eigen::Vector3d(keyframe.T_cw * point.p_w), VectorNear(p_c, 1e-9)) << point.id;
  }
}

TEST(DrawTogether, TheKeyframeTakesThePlacesPointsForThoseItHadAndForNone) {
  Map map = Line(2);
  map.keyframes[0].features.resize(3);
  map.keyframes[1].features.resize(4);
  for (Keyframe& keyframe : map.keyframes) {
    for (PointFeature& feature : keyframe.features) feature.depth_m = 2.0;
    keyframe.map_points.assign(keyframe.features.size(), kNone);
  }
  const int seen = AddPoint(map, {0.5, 0.0, 2.0}, 0, 0, {});
  const int twice = AddPoint(map, {0.5, 0.3, 2.0}, 0, 1, {});
  const int known = AddPoint(map, {0.5, -0.3, 2.0}, 0, 2, {});
  const int own = AddPoint(map, {0.6, 0.4, 2.1}, 1, 1, {});
  AddObservation(map, known, 1, 2);
  Loop loop = LoopFrom(map, 1.0);  // nothing has drifted
  loop.map_points = {seen, twice, known, kNone};
  LocalMappingConfig mapping;
  mapping.fusion.neighbours = 0;
  EXPECT_EQ(Close(map, loop, mapping).fused, 2) << "one was known before";
  EXPECT_THAT(map.keyframes[1].map_points, ElementsAre(seen, twice, known, kNone));
  EXPECT_EQ(CurrentPoint(map, own), twice);
  // They are seen from both sides now: on the whole, straight on.
  EXPECT_THAT(map.points[static_cast<std::size_t>(seen)].view_w,
              VectorNear(Eigen::Vector3d(0, 0, 1), 1e-12));
  EXPECT_THAT(map.points[static_cast<std::size_t>(twice)].view_w,
              VectorNear(Eigen::Vector3d(0, 0.3, 2).normalized(), 1e-12));
}

TEST(DrawTogether, TheKeyframeGetsWhatThePlaceSeesBesidesToo) {
  const Camera camera;
  Map map = Line(3);
  Pose true_cw;
  true_cw.t.x() = -0.3;
  Random random{8};
  const std::vector<Eigen::Vector3d> things_w{{0.0, 0.0, 2.0}, {0.4, 0.1, 2.0}};
  for (const Eigen::Vector3d& p_w : things_w) {
    const Descriptor look = AnyDescriptor(random);
    for (Keyframe* keyframe : {&map.keyframes[0], &map.keyframes[2]}) {
      const Pose& seen_cw = keyframe->id == 0 ? keyframe->T_cw : true_cw;
      keyframe->features.push_back(FeatureOfPoint(p_w, seen_cw, camera, look, true));
      keyframe->map_points.push_back(kNone);
    }
  }
  for (int f = 0; f < 2; ++f) AddPoint(map, things_w[static_cast<std::size_t>(f)], 0, f, {});
  Loop loop = LoopFrom(map, 0.3);
  loop.map_points = {0, kNone};  // the other was not recognised
  EXPECT_EQ(Close(map, loop).fused, 2);
  EXPECT_THAT(map.keyframes[2].map_points, ElementsAre(0, 1));
}

TEST(DrawTogether, AMapInWhichNothingIsSeenIsNotAdjusted) {
  Map map = Chain(5);
  EXPECT_FALSE(Close(map, LoopFrom(map, 3.5), {}, 10).adjusted);
  ExpectAt(map, {0, 0.9, 1.8, 2.7, 3.6});
}

}  // namespace
}  // namespace slam
