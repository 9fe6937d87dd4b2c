#include "slam/mapping/keyframes.h"

#include <gmock/gmock.h>

#include "slam/mapping/map_points.h"
#include "slam/model/map_queries.h"
#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

Frame FrameOf(const Keyframe& keyframe) {
  Frame frame;
  frame.index = keyframe.frame_index + 5;
  frame.T_cw = keyframe.T_cw;
  frame.features = keyframe.features;
  frame.map_points = keyframe.map_points;
  return frame;
}

TEST(Keyframes, KeepWhenAndWhereTheirFrameWasTakenAndHowItWasRead) {
  PointWorld world = MakePointWorld(2, 80, 1);
  Frame frame = FrameOf(world.map.keyframes[1]);
  frame.index = 37, frame.timestamp_s = 12.5;
  frame.readout.taken_out_s = 0.02, frame.readout.sigma_s = 0.003;
  frame.readout.speed << 1, 2, 3, 4, 5, 6;
  InsertKeyframe(frame, world.map, world.camera, FeatureScale{}, {});
  const Keyframe& kept = world.map.keyframes.back();
  EXPECT_EQ(kept.frame_index, 37);
  EXPECT_EQ(kept.timestamp_s, 12.5);
  EXPECT_THAT(kept.T_cw, PoseNear(frame.T_cw, 0, 0));
  EXPECT_EQ(kept.readout.taken_out_s, 0.02);
  EXPECT_EQ(kept.readout.sigma_s, 0.003);
  EXPECT_EQ(kept.readout.speed, frame.readout.speed);
}

TEST(Keyframes, AddAnObservationForEachMatchAndAPointForEachUnmatchedDepth) {
  PointWorld world = MakePointWorld(2, 80, 1);
  Frame frame = FrameOf(world.map.keyframes[1]);
  const int matched = frame.map_points[0];
  frame.map_points[1] = kNone;
  frame.map_points[2] = kNone;
  frame.features[2].depth_m = 0;
  const std::size_t points_before = world.map.points.size();
  const std::size_t seen_before =
      world.map.points[static_cast<std::size_t>(matched)].observations.size();

  const int id = InsertKeyframe(frame, world.map, world.camera, FeatureScale{}, {});
  EXPECT_EQ(id, 2);
  EXPECT_EQ(world.map.points.size(), points_before + 1);
  EXPECT_EQ(world.map.points[static_cast<std::size_t>(matched)].observations.size(),
            seen_before + 1);
  EXPECT_EQ(frame.map_points, world.map.keyframes[2].map_points);
  EXPECT_EQ(frame.map_points[2], kNone);
  // The new point lies where the feature saw it.
  const MapPoint& made = world.map.points.back();
  EXPECT_THAT(Eigen::Vector3d(frame.T_cw * made.p_w),
              VectorNear(Eigen::Vector3d(world.camera.Backproject(frame.features[1].u_px,
                                                                  frame.features[1].depth_m)),
                         1e-12));
}

TEST(Keyframes, ForgetMatchesWithPointsThatWereCulledAndFollowFusedOnes) {
  PointWorld world = MakePointWorld(2, 80, 2);
  Frame frame = FrameOf(world.map.keyframes[1]);
  for (PointFeature& feature : frame.features) feature.depth_m = 0;
  const int culled = frame.map_points[0], fused = frame.map_points[1];
  const int into =
      PointAt(world.map, 0, 0) == fused ? PointAt(world.map, 0, 1) : PointAt(world.map, 0, 0);
  for (int& slot : frame.map_points) slot = slot == into ? kNone : slot;
  CullPoint(world.map, culled);
  if (culled != into) ReplacePoint(world.map, fused, into);
  InsertKeyframe(frame, world.map, world.camera, FeatureScale{}, {});
  EXPECT_EQ(frame.map_points[0], kNone);
  EXPECT_EQ(frame.map_points[1], culled == into ? fused : into);
}

TEST(Keyframes, ShareAsManyPointsOneWayAsTheOther) {
  const Map map = MakePointWorld(5, 150, 3).map;
  for (const Keyframe& keyframe : map.keyframes) {
    EXPECT_FALSE(keyframe.covisible.empty());
    for (const auto& [other, shared] : keyframe.covisible) {
      EXPECT_EQ(map.keyframes[static_cast<std::size_t>(other)].covisible.at(keyframe.id),
                shared);
    }
  }
}

TEST(Keyframes, RankTheirNeighboursBySharedPoints) {
  Map map = MakePointWorld(5, 150, 4).map;
  const auto best = BestCovisible(map, 0, 3);
  ASSERT_EQ(best.size(), 3u);
  const auto& shared = map.keyframes[0].covisible;
  EXPECT_GE(shared.at(best[0]), shared.at(best[1]));
  EXPECT_GE(shared.at(best[1]), shared.at(best[2]));
  EXPECT_THAT(BestCovisible(map, 0, 0), testing::IsEmpty());
}

TEST(Keyframes, AreCulledWhenOthersSeeTheSameExceptTheFirstAndTheNewestTwo) {
  PointWorld world = MakePointWorld(6, 200, 5);
  const int culled = CullKeyframes(world.map, 5, world.camera, FeatureScale{}, {});
  EXPECT_GE(culled, 1);
  EXPECT_FALSE(world.map.keyframes[0].culled);
  EXPECT_FALSE(world.map.keyframes[4].culled);
  EXPECT_FALSE(world.map.keyframes[5].culled);
  for (const Keyframe& keyframe : world.map.keyframes) {
    EXPECT_EQ(keyframe.features.capacity() == 0, keyframe.culled);  // memory is given back
  }
  for (const MapPoint& point : world.map.points) {
    for (const auto& [keyframe, feature] : point.observations) {
      EXPECT_FALSE(world.map.keyframes[static_cast<std::size_t>(keyframe)].culled);
    }
  }
}

TEST(Keyframes, AreCulledForViewsAtTheirScaleOrFinerOnes) {
  const auto culled = [](int own_octave, int others_octave) {
    PointWorld world = MakePointWorld(6, 200, 5);
    for (Keyframe& keyframe : world.map.keyframes) {
      const int octave = keyframe.id == 2 ? own_octave : others_octave;
      for (PointFeature& feature : keyframe.features) feature.octave = octave;
    }
    CullKeyframes(world.map, 5, world.camera, FeatureScale{}, {});
    return world.map.keyframes[2].culled;
  };
  EXPECT_TRUE(culled(1, 1));
  EXPECT_TRUE(culled(1, 2));  // an octave is how well a scale is known
  EXPECT_TRUE(culled(4, 0));
  EXPECT_FALSE(culled(0, 2));  // the others saw the points from afar
}

TEST(Keyframes, FollowTheOneThatReplacedThemWhenItMoves) {
  PointWorld world = MakePointWorld(6, 200, 6);
  std::vector<Pose> before;
  for (const Keyframe& keyframe : world.map.keyframes) before.push_back(keyframe.T_cw);
  CullKeyframes(world.map, 5, world.camera, FeatureScale{}, {});
  const Pose T_wv{ExpSo3({0.1, -0.2, 0.3}), {1, 2, 3}};  // v: the world, moved
  int checked = 0;
  for (Keyframe& keyframe : world.map.keyframes) {
    if (!keyframe.culled) keyframe.T_cw = keyframe.T_cw * T_wv;
  }
  for (const Keyframe& keyframe : world.map.keyframes) {
    checked += keyframe.culled;
    EXPECT_THAT(KeyframePose(world.map, keyframe.id),
                PoseNear(before[static_cast<std::size_t>(keyframe.id)] * T_wv, 1e-9, 1e-9));
  }
  EXPECT_GE(checked, 1);
}

TEST(Keyframes, FollowAChainOfThoseThatReplacedThem) {
  Map map;
  map.keyframes.resize(3);
  const Pose T_01{ExpSo3({0.1, 0.4, -0.2}), {0.3, 0.0, 0.1}};
  const Pose T_12{ExpSo3({-0.5, 0.2, 0.3}), {0.0, 0.7, -0.2}};
  const Pose T_2w{ExpSo3({0.2, -0.1, 0.9}), {1.0, 2.0, 3.0}};
  for (int k = 0; k < 2; ++k) {
    Keyframe& gone = map.keyframes[static_cast<std::size_t>(k)];
    gone.culled = true, gone.parent = k + 1, gone.T_cp = k == 0 ? T_01 : T_12;
  }
  map.keyframes[2].T_cw = T_2w;
  EXPECT_THAT(KeyframePose(map, 0), PoseNear(T_01 * T_12 * T_2w, 1e-12, 1e-12));
}

TEST(Keyframes, AreNotCulledBesideOrAfterTheOneAsked) {
  PointWorld world = MakePointWorld(8, 200, 5);
  EXPECT_EQ(CullKeyframes(world.map, 3, world.camera, FeatureScale{}, {}), 1);
  EXPECT_TRUE(world.map.keyframes[1].culled);  // others see the same of 2, and of 4 to 7
}

TEST(Keyframes, AreKeptWhileATenthOfTheirClosePointsIsTheirs) {
  for (const double share : {0.05, 0.2}) {
    PointWorld world = MakePointWorld(8, 300, 7);
    const std::vector<int> points = world.map.keyframes[1].map_points;
    const auto alone = static_cast<std::size_t>(share * static_cast<double>(points.size()));
    for (std::size_t f = 0; f < alone; ++f) {
      for (int k = 0; k < 8; ++k) {
        if (k != 1 && points[f] != kNone) RemoveObservation(world.map, points[f], k);
      }
    }
    // A point that one keyframe alone sees was culled with its last partner: make it anew.
    for (std::size_t f = 0; f < alone; ++f) {
      Keyframe& keyframe = world.map.keyframes[1];
      if (keyframe.map_points[f] != kNone) continue;
      const PointFeature& seen = keyframe.features[f];
      AddPoint(world.map,
               Inverse(keyframe.T_cw) * world.camera.Backproject(seen.u_px, seen.depth_m), 1,
               static_cast<int>(f), {});
    }
    CullKeyframes(world.map, 3, world.camera, FeatureScale{}, {});
    EXPECT_EQ(world.map.keyframes[1].culled, share < 0.1);
  }
}

/// How many points a keyframe sees, near and beyond what its depth is trusted to, alone and with
/// five others.
struct PointCounts {
  int close_alone = 0, close_shared = 0, far_alone = 0, far_shared = 0;
};

/// Whether such a keyframe is culled.
bool IsCulled(const PointCounts& seen) {
  const Camera camera;
  const double close_m = FeatureScale{}.CloseDepth_m(camera.fx);
  constexpr int kViews = 6, kId = 1;
  Map map;
  map.keyframes.resize(kViews);
  for (int k = 0; k < kViews; ++k) map.keyframes[static_cast<std::size_t>(k)].id = k;
  const auto add = [&](int points, double depth_m, bool shared) {
    for (int i = 0; i < points; ++i) {
      const int f = static_cast<int>(map.keyframes[kId].features.size());
      for (Keyframe& keyframe : map.keyframes) {
        keyframe.features.emplace_back();
        keyframe.features.back().u_px = {2.0 * f, 100.0};
        keyframe.features.back().depth_m = depth_m;
        keyframe.map_points.push_back(kNone);
      }
      const Eigen::Vector3d p_w = camera.Backproject({2.0 * f, 100.0}, depth_m);
      const int point = AddPoint(map, p_w, kId, f, {});
      for (int k = 0; shared && k < kViews; ++k) AddObservation(map, point, k, f);
    }
  };
  add(seen.close_alone, 0.9 * close_m, false), add(seen.close_shared, 0.9 * close_m, true);
  add(seen.far_alone, 1.1 * close_m, false), add(seen.far_shared, 1.1 * close_m, true);
  for (int k = 0; k < kViews; ++k) UpdateCovisibility(map, k, {});
  CullKeyframes(map, kViews - 1, camera, FeatureScale{}, {});
  return map.keyframes[kId].culled;
}

TEST(Keyframes, AreKeptForTheirCloseDepthsAlone) {
  EXPECT_TRUE(IsCulled({.close_shared = 20}));
  EXPECT_FALSE(IsCulled({.close_alone = 20, .close_shared = 20}));
  EXPECT_TRUE(IsCulled({.close_shared = 20, .far_alone = 100}));
  EXPECT_FALSE(IsCulled({.close_alone = 20, .close_shared = 20, .far_shared = 200}));
}

TEST(Keyframes, AreTiedBothWaysToTheOneThatSharesMostWhereNoneSharesEnough) {
  Map map;
  map.keyframes.resize(3);
  for (int k = 0; k < 3; ++k) {
    map.keyframes[static_cast<std::size_t>(k)].id = k;
    map.keyframes[static_cast<std::size_t>(k)].features.resize(3);
    map.keyframes[static_cast<std::size_t>(k)].map_points.assign(3, kNone);
  }
  for (int f = 0; f < 3; ++f) {  // 0 and 2 share three points, 1 and 2 one
    const int id = AddPoint(map, {0, 0, 1}, 2, f, {});
    AddObservation(map, id, 0, f);
    if (f == 0) AddObservation(map, id, 1, f);
  }
  UpdateCovisibility(map, 2, {});
  using testing::ElementsAre;
  using testing::Pair;
  EXPECT_THAT(map.keyframes[2].covisible, ElementsAre(Pair(0, 3)));
  EXPECT_THAT(map.keyframes[0].covisible, ElementsAre(Pair(2, 3)));
  EXPECT_THAT(map.keyframes[1].covisible, testing::IsEmpty());
}

TEST(Keyframes, MakePointsOfAllCloseDepthsAndOfTheNearestHundredOtherwise) {
  KeyframeConfig config;
  Camera camera;
  camera.fy = 2 * camera.fx;
  const double close_m = FeatureScale{}.CloseDepth_m(camera.fx);
  for (const int close : {60, 150}) {
    Frame frame;
    frame.features.resize(200);
    frame.map_points.assign(200, kNone);
    for (int f = 0; f < 200; ++f) {
      PointFeature& feature = frame.features[static_cast<std::size_t>(f)];
      feature.u_px = {3.0 * f, 100.0};
      feature.depth_m = f < close ? 0.9 * close_m : 1.1 * close_m;
    }
    Map map;
    InsertKeyframe(frame, map, camera, FeatureScale{}, config);
    EXPECT_EQ(static_cast<int>(map.points.size()), std::max(close, config.min_new_points));
  }
}

TEST(Keyframes, AreForgottenByTheirNeighboursWhenTheyAreCulled) {
  PointWorld world = MakePointWorld(6, 200, 5);
  for (Keyframe& keyframe : world.map.keyframes) {  // each has seen something nobody knows
    keyframe.features.emplace_back();
    keyframe.map_points.push_back(kNone);
  }
  EXPECT_GE(CullKeyframes(world.map, 5, world.camera, FeatureScale{}, {}), 1);
  for (const Keyframe& keyframe : world.map.keyframes) {
    EXPECT_EQ(keyframe.covisible.empty(), keyframe.culled) << keyframe.id;
    for (const auto& [other, shared] : keyframe.covisible) {
      EXPECT_FALSE(world.map.keyframes[static_cast<std::size_t>(other)].culled) << keyframe.id;
    }
  }
}

TEST(Keyframes, GiveTheirPlanesBackWhenTheyAreCulled) {
  PointWorld world = MakePointWorld(6, 200, 6);
  for (Keyframe& keyframe : world.map.keyframes) keyframe.planes.resize(2);
  EXPECT_GE(CullKeyframes(world.map, 5, world.camera, FeatureScale{}, {}), 1);
  for (const Keyframe& keyframe : world.map.keyframes) {
    EXPECT_EQ(keyframe.planes.size(), keyframe.culled ? 0u : 2u);
  }
}

}  // namespace
}  // namespace slam
