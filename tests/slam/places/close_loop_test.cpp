#include "slam/places/close_loop.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "slam/mapping/bundle/plane_terms.h"
#include "slam/model/map_queries.h"
#include "slam/places/carry_map.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/ring_world.h"
#include "tests/support/seen_landmark.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

constexpr int kLast = 39;

LoopClosingConfig Closing(int full_iterations = 10) {
  LoopClosingConfig config;
  config.enabled = true;
  config.full_iterations = full_iterations;
  return config;
}

std::optional<Loop> Detect(const RingWorld& world, int keyframe,
                           const LoopDetectionConfig& config = {},
                           const PointSearchConfig& search = {}) {
  KeyframeIndex index(world.vocabulary);
  index.Update(world.map);
  return DetectLoop(world.map, index, keyframe, world.camera, FeatureScale{}, search, config);
}

double WorstError(const Map& map, const std::vector<Pose>& truth) {
  double worst = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    const Pose& true_cw = truth[static_cast<std::size_t>(keyframe.id)];
    worst = std::max(worst, (Inverse(keyframe.T_cw).t - Inverse(true_cw).t).norm());
  }
  return worst;
}

TEST(LoopDetection, KnowsThePlaceItStartedFromAndWhereItIs) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  EXPECT_EQ(loop->keyframe, kLast);
  EXPECT_LT(loop->place, 5);
  // The place was mapped with little drift: the pose from its points is nearly the true one.
  EXPECT_THAT(loop->T_cw, PoseNear(world.truth[kLast], 0.01, 0.03));
  EXPECT_GT((Inverse(world.map.keyframes[kLast].T_cw).t - Inverse(world.truth[kLast]).t).norm(),
            0.1);
}

TEST(LoopDetection, DoesNotDependOnWhereTheWorldsOriginIs) {
  RingWorld world = MakeRingWorld();
  const Eigen::Vector3d shift(300, 0, -400);
  for (Keyframe& k : world.map.keyframes) k.T_cw.t -= k.T_cw.R * shift;
  for (MapPoint& point : world.map.points) point.p_w += shift;
  const auto loop = Detect(world, kLast), near = Detect(MakeRingWorld(), kLast);
  ASSERT_TRUE(loop);
  ASSERT_TRUE(near);
  EXPECT_EQ(loop->place, near->place);
  const Pose T_here{loop->T_cw.R, loop->T_cw.t + loop->T_cw.R * shift};
  EXPECT_THAT(T_here, PoseNear(near->T_cw, 1e-3, 1e-3));
}

TEST(LoopDetection, SeesNoLoopOnTheWay) {
  const RingWorld world = MakeRingWorld();
  for (const int keyframe : {3, 12, 20, 28}) {
    // Asked as it was then: what came later is not in the map yet.
    RingWorld then = world;
    then.map.keyframes.resize(static_cast<std::size_t>(keyframe) + 1);
    for (Keyframe& k : then.map.keyframes) {
      std::erase_if(k.covisible, [&](const auto& e) { return e.first > keyframe; });
    }
    EXPECT_FALSE(Detect(then, keyframe)) << keyframe;
  }
}

// Fails when the look of a place is enough: half a ring farther everything looks the same.
TEST(LoopDetection, RefusesAPlaceThatOnlyLooksTheSame) {
  RingShape twice;
  twice.alike = 2;
  const RingWorld world = MakeRingWorld(twice);
  RingWorld then = world;
  then.map.keyframes.resize(21);
  for (Keyframe& k : then.map.keyframes) {
    std::erase_if(k.covisible, [&](const auto& e) { return e.first > 20; });
  }
  EXPECT_FALSE(Detect(then, 20));
  LoopDetectionConfig credulous;
  credulous.base_drift_m = credulous.base_drift_rad = 100;
  EXPECT_TRUE(Detect(then, 20, credulous)) << "the two places are not alike enough to tell";
}

TEST(LoopDetection, DoubtsTwoPlacesThatFitAlikeUnlessItMayAskOneAlone) {
  RingShape shape;
  shape.alike = 4;  // keyframes 0, 10, 20 and 30 see the same
  const RingWorld world = MakeRingWorld(shape);
  LoopDetectionConfig credulous;
  credulous.base_drift_m = credulous.base_drift_rad = 100;
  PointSearchConfig search;
  EXPECT_FALSE(Detect(world, 30, credulous, search));
  search.place.max_keyframes = 1;
  EXPECT_TRUE(Detect(world, 30, credulous, search));
}

TEST(LoopDetection, LooksForOlderPlacesAlone) {
  const RingWorld world = MakeRingWorld();
  LoopDetectionConfig credulous;
  credulous.base_drift_m = credulous.base_drift_rad = 100;
  EXPECT_TRUE(Detect(world, kLast, credulous));
  for (const int early : {0, 1, 2}) EXPECT_FALSE(Detect(world, early, credulous)) << early;
}

TEST(LoopDetection, RefusesAPlaceThatLooksMuchLessLikeItThanItsNeighboursDo) {
  LoopDetectionConfig strict;
  strict.min_likeness_ratio = 1e3;
  EXPECT_FALSE(Detect(MakeRingWorld(), kLast, strict));
}

TEST(LoopDetection, NeedsAsManyInliersAsAsked) {
  const RingWorld world = MakeRingWorld();
  LoopDetectionConfig config;
  const auto loop = Detect(world, kLast, config);
  ASSERT_TRUE(loop);
  config.min_inliers = loop->inliers;
  EXPECT_TRUE(Detect(world, kLast, config));
  config.min_inliers = loop->inliers + 1;
  EXPECT_FALSE(Detect(world, kLast, config));
}

TEST(LoopDetection, AllowsForDriftByTheLengthOfTheWay) {
  const RingWorld world = MakeRingWorld();
  LoopDetectionConfig config;
  config.base_drift_rad = 1.0;
  const auto loop = Detect(world, kLast, config);
  ASSERT_TRUE(loop);
  const double moved_m =
      (Inverse(loop->T_cw).t - Inverse(world.map.keyframes[kLast].T_cw).t).norm();
  // Steps on a circle of 1 m, which the drift changes by a fortieth.
  const double way_m = (kLast - loop->place) * 2 * std::sin(M_PI / (kLast + 1));
  config.base_drift_m = 0.0;
  config.drift_per_m = 1.1 * moved_m / way_m;
  EXPECT_TRUE(Detect(world, kLast, config));
  config.drift_per_m = 0.9 * moved_m / way_m;
  EXPECT_FALSE(Detect(world, kLast, config));
}

TEST(LoopDetection, AllowsForATurnByTheLengthOfTheWay) {
  const RingWorld world = MakeRingWorld();
  LoopDetectionConfig config;
  config.base_drift_m = 1.0;
  const auto loop = Detect(world, kLast, config);
  ASSERT_TRUE(loop);
  const Pose& before_cw = world.map.keyframes[kLast].T_cw;
  const double turned_rad = LogSo3(loop->T_cw.R * before_cw.R.transpose()).norm();
  const double way_m = (kLast - loop->place) * 2 * std::sin(M_PI / (kLast + 1));
  config.base_drift_rad = 0.0;
  config.drift_rad_per_m = 1.1 * turned_rad / way_m;
  EXPECT_TRUE(Detect(world, kLast, config));
  config.drift_rad_per_m = 0.9 * turned_rad / way_m;
  EXPECT_FALSE(Detect(world, kLast, config));
}

TEST(LoopDetection, FindsPointsThatTheNeighboursOfThePlaceKnowAndItDoesNot) {
  RingWorld world = MakeRingWorld();
  const auto first = Detect(world, kLast);
  ASSERT_TRUE(first);
  // The place loses every other point of those.
  for (std::size_t f = 0; f < first->map_points.size(); f += 2) {
    if (first->map_points[f] == kNone) continue;
    RemoveObservation(world.map, first->map_points[f], first->place);
  }
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  int besides = 0;
  for (std::size_t f = 0; f < first->map_points.size(); ++f) {
    if (CurrentPoint(world.map, first->map_points[f]) == kNone) continue;
    EXPECT_EQ(loop->map_points[f], first->map_points[f]) << f;
    besides += f % 2 == 0 ? 1 : 0;
  }
  EXPECT_GT(besides, 20);
}

TEST(LoopDetection, NamesEachPointOnceThoughAnotherFeatureLooksLikeIt) {
  RingWorld world = MakeRingWorld();
  Keyframe& newest = world.map.keyframes[kLast];
  const std::vector<PointFeature> features = newest.features;
  for (PointFeature feature : features) {  // a double of each, a pixel and a half beside
    feature.u_px.x() += 1.5;
    for (std::size_t byte = 0; byte < 5; ++byte) {
      feature.descriptor[byte] = static_cast<std::uint8_t>(~feature.descriptor[byte]);
    }
    newest.features.push_back(feature);
    newest.map_points.push_back(kNone);
  }
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  std::vector<int> named = loop->map_points;
  std::erase(named, kNone);
  std::sort(named.begin(), named.end());
  EXPECT_EQ(std::adjacent_find(named.begin(), named.end()), named.end());
}

TEST(LoopDetection, KeepsWhatItKnewThePlaceByThoughATwinFromBesideLooksMoreAlike) {
  RingWorld world = MakeRingWorld();
  const auto first = Detect(world, kLast);
  ASSERT_TRUE(first);
  ASSERT_NE(first->map_points[0], kNone);
  Map& map = world.map;
  PointFeature& seen = map.keyframes[kLast].features[0];
  seen.descriptor[0] = static_cast<std::uint8_t>(~seen.descriptor[0]);
  const int neighbour = first->place == 2 ? 3 : 2;
  Keyframe& there = map.keyframes[static_cast<std::size_t>(neighbour)];
  there.features.push_back(seen);
  there.map_points.push_back(kNone);
  const Eigen::Vector3d p_w = map.points[static_cast<std::size_t>(first->map_points[0])].p_w;
  AddPoint(map, p_w, neighbour, static_cast<int>(there.features.size()) - 1, {});
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  EXPECT_NE(loop->place, neighbour);
  EXPECT_EQ(loop->map_points[0], first->map_points[0]);
}

TEST(LoopDetection, NamesNoPointThatTheKeyframeSeesAlready) {
  RingWorld world = MakeRingWorld();
  const auto first = Detect(world, kLast);
  ASSERT_TRUE(first);
  // A thing that both ends of the way have mapped. The place knows it by the newer point alone,
  // from a neighbour.
  Map& map = world.map;
  Keyframe& newest = map.keyframes[kLast];
  std::size_t f = 0;
  const auto seen_by_others_too = [&](int id) {
    return id != kNone && map.points[static_cast<std::size_t>(id)].observations.size() > 2;
  };
  while (first->map_points[f] == kNone || !seen_by_others_too(newest.map_points[f])) ++f;
  const int own = newest.map_points[f], neighbour = first->place == 2 ? 3 : 2;
  CullPoint(map, first->map_points[f]);
  Keyframe& there = map.keyframes[static_cast<std::size_t>(neighbour)];
  there.features.push_back(newest.features[f]);
  there.map_points.push_back(kNone);
  AddObservation(map, own, neighbour, static_cast<int>(there.features.size()) - 1);
  map.points[static_cast<std::size_t>(own)].p_w =
      Inverse(first->T_cw) *
      world.camera.Backproject(newest.features[f].u_px, newest.features[f].depth_m);
  UpdatePoint(map, own, {});
  const auto names_it = [&] {
    const auto loop = Detect(world, kLast);
    EXPECT_TRUE(loop && loop->place != neighbour);
    return loop && loop->map_points[f] == own;
  };
  EXPECT_FALSE(names_it());
  RemoveObservation(map, own, kLast);
  EXPECT_TRUE(names_it());
}

TEST(CloseLoop, DrawsTheMapTogether) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map map = world.map;
  MapPlane wall;  // on points of the newest keyframe
  wall.first_frame = map.keyframes.back().frame_index;
  const int seen = PointAt(map, kLast, 3);
  wall.pi_w = {Eigen::Vector3d::UnitX(), -map.points[static_cast<std::size_t>(seen)].p_w.x()};
  wall.centroid_w = map.points[static_cast<std::size_t>(seen)].p_w;
  AddLandmark(map, wall);
  const double before = WorstError(map, world.truth);
  const LoopReport report = CloseLoop(map, *loop, world.camera, FeatureScale{}, {}, Closing());
  EXPECT_GT(report.moved_m, 0.1);
  EXPECT_GT(report.fused, 40);
  EXPECT_TRUE(report.adjusted);
  EXPECT_LT(WorstError(map, world.truth), before / 5);
  EXPECT_THAT(map.keyframes[0].T_cw, PoseNear(world.truth[0], 0.0, 0.0));
  // The plane went along with what it was seen with.
  const Pose carried = Inverse(map.keyframes[kLast].T_cw) * world.map.keyframes[kLast].T_cw;
  EXPECT_THAT(map.planes.At(0).centroid_w, VectorNear(carried * wall.centroid_w, 1e-9));
  EXPECT_NEAR(SignedDistance(map.planes.At(0).pi_w, map.planes.At(0).centroid_w), 0, 1e-9);
}

TEST(CloseLoop, LeavesNoStepOfTheWayMoreThanItsShare) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map map = world.map;
  ASSERT_GT(CloseLoop(map, *loop, world.camera, FeatureScale{}, {}, Closing(0)).moved_m, 0.1);
  for (std::size_t k = 1; k < map.keyframes.size(); ++k) {
    const Pose step = map.keyframes[k].T_cw * Inverse(map.keyframes[k - 1].T_cw);
    EXPECT_THAT(step, PoseNear(world.truth[k] * Inverse(world.truth[k - 1]), 0.0025, 0.003))
        << k;
  }
}

/// Squared errors, in sigmas, of what keyframes have seen of a landmark that stands there.
double ErrorOf(const Map& map, int landmark, const Plane& pi_w, const Eigen::Vector3d& x_w) {
  double sum = 0;
  for (const Keyframe& keyframe : map.keyframes) {
    for (const KeyframePlane& seen : keyframe.planes) {
      if (seen.map_plane != landmark) continue;
      const PoseBlock pose = BlockOf(keyframe.T_cw);
      const PlaneBlock plane = BlockOf(pi_w, x_w);
      const double* const blocks[] = {pose.data(), plane.data()};
      Eigen::Vector4d residual;
      PlaneTerm(seen, x_w).Evaluate(blocks, residual.data(), nullptr);
      sum += residual.squaredNorm();
    }
  }
  return sum;
}

/// The adjustment of the whole map places landmarks: turned or shifted, they would not fit better.
TEST(CloseLoop, LeavesPlanesWhereTheirKeyframesSeeThem) {
  constexpr double kThirdOfASigma = 0.1;  // its square: they also weigh what was known before
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map map = world.map;
  const Eigen::Vector3d x_w = Inverse(map.keyframes[kLast].T_cw) * Eigen::Vector3d(0, 0, 2);
  for (const Plane& pi_w : ThreePlanes()) {
    const int id = AddSeenLandmark(map, {pi_w.n, -pi_w.n.dot(x_w)}, x_w);
    map.planes.At(id).first_frame = map.keyframes[kLast - 1].frame_index;
  }
  for (Keyframe& keyframe : map.keyframes)
    if (keyframe.id < kLast - 1) keyframe.planes.clear();
  ASSERT_TRUE(CloseLoop(map, *loop, world.camera, FeatureScale{}, {}, Closing(50)).adjusted);
  for (const MapPlane& landmark : map.planes) {
    const Eigen::Vector3d at_w = ProjectOnto(landmark.pi_w, landmark.centroid_w);
    const double least = ErrorOf(map, landmark.id, landmark.pi_w, at_w);
    for (int axis = 0; axis < 3; ++axis) {
      for (const double step : {-3e-4, 3e-4}) {
        Plane moved = landmark.pi_w;
        moved.n = ExpSo3(step * Eigen::Vector3d::Unit(axis)) * moved.n;
        moved.d = -moved.n.dot(at_w);
        EXPECT_GE(ErrorOf(map, landmark.id, moved, at_w), least - kThirdOfASigma);
        moved = landmark.pi_w;
        moved.d += step;
        EXPECT_GE(ErrorOf(map, landmark.id, moved, at_w), least - kThirdOfASigma);
      }
    }
  }
}

// Fails when nothing but the full adjustment holds the map together.
TEST(CloseLoop, ThePoseGraphAloneTakesMostOfTheDrift) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map map = world.map;
  const LoopReport report = CloseLoop(map, *loop, world.camera, FeatureScale{}, {}, Closing(0));
  EXPECT_FALSE(report.adjusted);
  EXPECT_LT(WorstError(map, world.truth), 0.5 * WorstError(world.map, world.truth));
}

TEST(CloseLoop, TheAdjustmentOfAllTakesMostOfWhatThePoseGraphLeaves) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map spread = world.map, adjusted = world.map;
  CloseLoop(spread, *loop, world.camera, FeatureScale{}, {}, Closing(0));
  CloseLoop(adjusted, *loop, world.camera, FeatureScale{}, {}, Closing());
  EXPECT_LT(WorstError(adjusted, world.truth), 0.5 * WorstError(spread, world.truth));
}

TEST(CloseLoop, AdjustsForItsOwnNumberOfIterationsWhateverLocalMappingTakes) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  LocalMappingConfig idle;
  idle.bundle.first_iterations = idle.bundle.last_iterations = 0;
  Map one = world.map, two = world.map;
  ASSERT_TRUE(CloseLoop(one, *loop, world.camera, FeatureScale{}, {}, Closing()).adjusted);
  CloseLoop(two, *loop, world.camera, FeatureScale{}, idle, Closing());
  for (std::size_t k = 0; k < one.keyframes.size(); ++k) {
    EXPECT_EQ(one.keyframes[k].T_cw.t, two.keyframes[k].T_cw.t) << k;
  }
}

TEST(CloseLoop, IsTheSameTwice) {
  const RingWorld world = MakeRingWorld();
  const auto loop = Detect(world, kLast);
  ASSERT_TRUE(loop);
  Map one = world.map, two = world.map;
  ASSERT_TRUE(CloseLoop(one, *loop, world.camera, FeatureScale{}, {}, Closing()).adjusted);
  CloseLoop(two, *loop, world.camera, FeatureScale{}, {}, Closing());
  for (std::size_t k = 0; k < one.keyframes.size(); ++k) {
    EXPECT_EQ(one.keyframes[k].T_cw.t, two.keyframes[k].T_cw.t);
    EXPECT_EQ(one.keyframes[k].T_cw.R, two.keyframes[k].T_cw.R);
  }
}

}  // namespace
}  // namespace slam
