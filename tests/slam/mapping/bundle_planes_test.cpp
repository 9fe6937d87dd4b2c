#include "slam/mapping/bundle/bundle_planes.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "slam/base/index.h"
#include "tests/support/point_world.h"
#include "tests/support/seen_landmark.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

Eigen::Vector3d AnyShift(Random& random, double half) {
  return half * Eigen::Vector3d(2 * random.Uniform() - 1, 2 * random.Uniform() - 1,
                                2 * random.Uniform() - 1);
}

Pose AnyMove(Random& random, double half_m, double half_rad) {
  return {ExpSo3(AnyShift(random, half_rad)), AnyShift(random, half_m)};
}

/// Moves points, and all keyframes but the first, by a little, and planes as they are seen then.
void DisturbAll(Map& map, double half_m, double half_rad) {
  Random random{11};
  for (Keyframe& keyframe : map.keyframes) {
    if (keyframe.id > 0) keyframe.T_cw = AnyMove(random, half_m, half_rad) * keyframe.T_cw;
  }
  for (MapPoint& point : map.points) point.p_w += AnyShift(random, half_m);
  PlaceAsSeen(map);
}

PointWorld WorldWithPlanes(int keyframes, int points, const std::vector<Plane>& planes_w,
                           std::uint64_t seed = 1) {
  PointWorld world = MakePointWorld(keyframes, points, seed);
  AddSeenLandmarks(world.map, planes_w);
  return world;
}

LocalBundleConfig ManyIterations() {
  LocalBundleConfig config;
  config.last_iterations = 20;
  return config;
}

void ExpectKeyframesNear(const Map& map, const Map& truth, double rad, double m) {
  for (const Keyframe& keyframe : map.keyframes) {
    EXPECT_THAT(keyframe.T_cw,
                PoseNear(truth.keyframes[static_cast<std::size_t>(keyframe.id)].T_cw, rad, m));
  }
}

void ExpectPlanesNear(const Map& map, const Map& truth, double rad, double m) {
  for (const MapPlane& plane : map.planes) {
    EXPECT_THAT(plane.pi_w, PlaneNear(truth.planes.At(plane.id).pi_w, rad, m));
  }
}

double MeanPositionError(const Map& map, const Map& truth) {
  double sum = 0;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    sum += (Inverse(map.keyframes[k].T_cw).t - Inverse(truth.keyframes[k].T_cw).t).norm();
  }
  return sum / static_cast<double>(map.keyframes.size());
}

TEST(BundlePlanes, AreFoundAgainWithPosesAndPointsFromADisturbedMap) {
  for (const std::size_t count : {1u, 3u}) {
    std::vector<Plane> planes_w = ThreePlanes();
    planes_w.resize(count);
    const PointWorld truth = WorldWithPlanes(5, 80, planes_w);
    Map map = truth.map;
    DisturbAll(map, 0.005, 0.003);
    const LocalBundleReport report =
        AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, ManyIterations());
    EXPECT_TRUE(report.usable);
    EXPECT_EQ(report.planes, static_cast<int>(count));
    EXPECT_EQ(report.plane_outliers, 0);
    ExpectKeyframesNear(map, truth.map, 1e-4, 1e-4);
    ExpectPlanesNear(map, truth.map, 1e-4, 1e-4);
  }
}

TEST(BundlePlanes, CarryKeyframesThatSeeFewPoints) {
  double error[2] = {0, 0};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const PointWorld truth = WorldWithPlanes(5, 7, ThreePlanes(), seed);
    PointWorld noisy = truth;
    Random random{seed, 5};
    for (Keyframe& keyframe : noisy.map.keyframes) {
      for (PointFeature& feature : keyframe.features) {
        feature.u_px += AnyShift(random, 1.5).head<2>();
        feature.depth_m += 0.02 * (2 * random.Uniform() - 1);
      }
      for (KeyframePlane& plane : keyframe.planes) {
        const Eigen::Vector3d turned = ExpSo3(AnyShift(random, 0.005)) * plane.pi_c.n;
        plane.pi_c = {turned,
                      -turned.dot(plane.centroid_c) + 0.003 * (2 * random.Uniform() - 1)};
      }
    }
    for (const bool use_planes : {false, true}) {
      Map map = noisy.map;
      LocalBundleConfig config = ManyIterations();
      config.use_planes = use_planes;
      AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, config);
      error[use_planes] += MeanPositionError(map, truth.map);
    }
  }
  EXPECT_LT(error[true], 0.8 * error[false]);  // 0.65 over a thousand worlds
}

Plane FoundPlane(const BundleWindow& window, std::size_t i) {
  return PlaneOf(window.plane_blocks[i].data(), window.planes[i].reference_w);
}

/// Planes alone say nothing of some directions: these stay, the others are found.
TEST(BundlePlanes, AloneLeaveWhatTheyDoNotSeeWhereItWas) {
  // What holds the poses takes (0.01 / 0.1)^2 of what they were off by, 10 mrad or 10 mm.
  constexpr double kHeldBack = 3e-4;
  const Eigen::Vector3d n(0, 0, -1);
  for (const std::size_t count : {1u, 2u}) {  // two of them parallel
    std::vector<Plane> planes_w{{n, 2.0}, {n, 2.3}};
    planes_w.resize(count);
    const PointWorld truth = WorldWithPlanes(4, 0, planes_w);
    Map map = truth.map;
    DisturbAll(map, 0.01, 0.01);
    const Map before = map;
    BundleWindow window = FullWindow(map, truth.camera, FeatureScale{}, {});
    ASSERT_TRUE(SolveWindow(window, ManyIterations()).usable);
    MergeWindow(window, FeatureScale{}, map);
    for (std::size_t k = 1; k < map.keyframes.size(); ++k) {
      const Pose& T_cw = map.keyframes[k].T_cw;
      for (std::size_t i = 0; i < count; ++i) {
        const Plane& pi_w = map.planes.At(static_cast<int>(i)).pi_w;
        const KeyframePlane& seen = map.keyframes[k].planes[i];
        EXPECT_THAT(Transform(T_cw, pi_w), PlaneNear(seen.pi_c, kHeldBack, kHeldBack));
      }
      const Eigen::Vector3d moved = Inverse(T_cw).t - Inverse(before.keyframes[k].T_cw).t;
      EXPECT_LT(moved.head<2>().norm(), 0.02);  // a turn about the patch moves the camera, too
    }
  }
}

TEST(BundlePlanes, AWrongObservationIsTakenBackAndDoesNotBendTheMap) {
  const PointWorld truth = WorldWithPlanes(6, 80, ThreePlanes());
  for (const Eigen::Vector3d& turn : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.1, 0.1, 0)}) {
    Map map = truth.map;
    DisturbAll(map, 0.003, 0.002);
    KeyframePlane& wrong = map.keyframes[3].planes[1];
    wrong.pi_c.n = ExpSo3(turn) * wrong.pi_c.n;
    wrong.pi_c.d = -wrong.pi_c.n.dot(wrong.centroid_c) + (turn.norm() > 0 ? 0.0 : 0.04);
    const LocalBundleReport report =
        AdjustLocalBundle(map, 5, truth.camera, FeatureScale{}, ManyIterations());
    EXPECT_EQ(report.plane_outliers, 1);
    for (const Keyframe& keyframe : map.keyframes) {
      for (int i = 0; i < 3; ++i) {
        const bool taken_back = keyframe.id == 3 && i == 1;
        EXPECT_EQ(keyframe.planes[static_cast<std::size_t>(i)].map_plane,
                  taken_back ? kNone : i);
      }
    }
    // The landmarks started where all had seen them, the one that is wrong now among these.
    ExpectKeyframesNear(map, truth.map, 1e-4, 1e-4);
    ExpectPlanesNear(map, truth.map, 1e-3, 1e-3);
  }
}

/// Observations of keyframes outside of the window count as if these were in it, held.
TEST(BundlePlanes, AreHeldByKeyframesOutsideAsByFixedOnes) {
  PointWorld world = WorldWithPlanes(7, 80, ThreePlanes());
  Random random{3};
  for (Keyframe& keyframe : world.map.keyframes) {
    for (KeyframePlane& plane : keyframe.planes) {
      plane.pi_c.n = ExpSo3(AnyShift(random, 0.004)) * plane.pi_c.n;
      plane.pi_c.d = -plane.pi_c.n.dot(plane.centroid_c) + 0.003 * random.Uniform();
    }
  }
  LocalBundleConfig config = ManyIterations();
  config.max_keyframes = 1;
  const auto solved = [&](int max_fixed_keyframes, const Map& map) {
    config.max_fixed_keyframes = max_fixed_keyframes;
    BundleWindow window = LocalWindow(map, 6, world.camera, FeatureScale{}, config);
    EXPECT_EQ(SolveWindow(window, config).planes, 3);
    return window;
  };
  const BundleWindow fixed = solved(20, world.map), outside = solved(1, world.map);
  Map forgotten = world.map;  // those that are now outside have seen nothing
  for (Keyframe& keyframe : forgotten.keyframes) {
    if (std::find(outside.keyframes.begin(), outside.keyframes.end(), keyframe.id) ==
        outside.keyframes.end()) {
      keyframe.planes.clear();
    }
  }
  const BundleWindow unheld = solved(1, forgotten);
  for (std::size_t i = 0; i < 3; ++i) {
    const Plane expected = FoundPlane(fixed, i);
    EXPECT_THAT(FoundPlane(outside, i), PlaneNear(expected, 1e-4, 1e-4));
    EXPECT_THAT(FoundPlane(unheld, i), ::testing::Not(PlaneNear(expected, 5e-4, 5e-4)));
  }
}

TEST(BundlePlanes, AreNotHeldByAKeyframeOutsideThatContradictsThem) {
  // The chi-square bound of three degrees of freedom at 99.9 % is 16.27: 4.03 sigmas.
  for (const double off_sigmas : {3.9, 4.2}) {
    PointWorld world = WorldWithPlanes(5, 80, {ThreePlanes().front()});
    LocalBundleConfig config;
    config.max_keyframes = 2, config.max_fixed_keyframes = 1;
    const auto window = [&] {
      return LocalWindow(world.map, 4, world.camera, FeatureScale{}, config);
    };
    const Plane truth = world.map.planes.At(0).pi_w;
    const BundleWindow exact = window();
    ASSERT_EQ(exact.planes.size(), 1u);
    EXPECT_THAT(exact.planes[0].outside.Mean(), PlaneNear(truth, 1e-9, 1e-9));
    int outside = 0;
    while (std::count(exact.keyframes.begin(), exact.keyframes.end(), outside) > 0) ++outside;
    KeyframePlane& seen = world.map.keyframes.at(Index(outside)).planes.at(0);
    seen.pi_c.d += off_sigmas * seen.offset_sigma_m;
    const double moved_m = std::abs(window().planes.at(0).outside.Mean().d - truth.d);
    if (off_sigmas < 4) {
      EXPECT_GT(moved_m, seen.offset_sigma_m);  // a mean of two
    } else {
      EXPECT_LT(moved_m, 1e-9);
    }
  }
}

TEST(BundlePlanes, MoveWithAllThatTheyHave) {
  const PointWorld truth = WorldWithPlanes(5, 80, ThreePlanes());
  Map map = truth.map;
  DisturbAll(map, 0.005, 0.003);
  ASSERT_EQ(AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, {}).planes, 3);
  for (const MapPlane& plane : map.planes) {
    EXPECT_THAT(plane.estimate.Mean(), PlaneNear(plane.pi_w, 1e-9, 1e-9));
    for (const auto* points : {&plane.points_w, &plane.hull_w, &plane.vertices_w}) {
      EXPECT_NEAR(SignedDistance(plane.pi_w, points->front()), 0, 1e-9);
      EXPECT_THAT(points->front(), VectorNear(plane.centroid_w, 1e-9));
    }
  }
}

/// The bundle finds the plane itself; the landmark keeps what it has learnt from later frames.
TEST(BundlePlanes, AreFoundFromAnyStartAndMoveTheLandmarkByWhatTheyMoved) {
  const PointWorld truth = WorldWithPlanes(5, 80, ThreePlanes());
  Map map = truth.map;
  Random random{5};
  for (MapPlane& plane : map.planes) MovePlane(plane, AnyMove(random, 0.005, 0.003));
  const Map before = map;
  BundleWindow window = FullWindow(map, truth.camera, FeatureScale{}, {});
  SolveWindow(window, ManyIterations());
  MergeWindow(window, FeatureScale{}, map);
  for (std::size_t i = 0; i < 3; ++i) {
    const int id = static_cast<int>(i);
    EXPECT_THAT(FoundPlane(window, i), PlaneNear(truth.map.planes.At(id).pi_w, 1e-4, 1e-4));
    EXPECT_THAT(map.planes.At(id).pi_w, PlaneNear(before.planes.At(id).pi_w, 1e-4, 1e-4));
  }
}

// Who carries the rest of the map along has to know which landmarks are placed.
TEST(BundlePlanes, OnWhichNoKeyframeCountsAnyMoreAreNotPlaced) {
  const PointWorld truth = WorldWithPlanes(5, 80, ThreePlanes());
  for (const bool denied : {false, true}) {
    Map map = truth.map;
    DisturbAll(map, 0.005, 0.003);
    BundleWindow window = FullWindow(map, truth.camera, FeatureScale{}, {});
    SolveWindow(window, ManyIterations());
    for (BundleWindow::PlaneObservation& o : window.plane_observations) {
      if (denied && window.planes[o.plane_at].id == 1) o.inlier = false;
    }
    const Plane before = map.planes.At(1).pi_w;
    const std::set<int> placed = MergeWindow(window, FeatureScale{}, map);
    EXPECT_EQ(placed, denied ? std::set<int>({0, 2}) : std::set<int>({0, 1, 2}));
    EXPECT_EQ(map.planes.At(1).pi_w.d == before.d, denied);
  }
}

TEST(BundlePlanes, OfOneKeyframeAloneStayWhereTheyAre) {
  PointWorld world = WorldWithPlanes(5, 80, {ThreePlanes().front()});
  for (Keyframe& keyframe : world.map.keyframes) {
    if (keyframe.id != 4) keyframe.planes.clear();
  }
  DisturbAll(world.map, 0.005, 0.003);
  const Plane before = world.map.planes.At(0).pi_w;
  EXPECT_EQ(AdjustLocalBundle(world.map, 4, world.camera, FeatureScale{}, {}).planes, 0);
  EXPECT_EQ(world.map.planes.At(0).pi_w.n, before.n);
  EXPECT_EQ(world.map.planes.At(0).pi_w.d, before.d);
}

TEST(BundlePlanes, StandForTheLandmarksThatWereMergedIntoThem) {
  PointWorld truth = WorldWithPlanes(5, 80, {ThreePlanes().front(), ThreePlanes().front()});
  MapPlane& merged = truth.map.planes.At(1);
  merged.status = LandmarkStatus::kMerged, merged.merged_into = 0;
  for (Keyframe& keyframe : truth.map.keyframes) {  // either was seen, in turns
    keyframe.planes.erase(keyframe.planes.begin() + keyframe.id % 2);
  }
  Map map = truth.map;
  DisturbAll(map, 0.005, 0.003);
  const Plane before = map.planes.At(1).pi_w;
  EXPECT_EQ(AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, ManyIterations()).planes,
            1);
  EXPECT_THAT(map.planes.At(0).pi_w, PlaneNear(truth.map.planes.At(0).pi_w, 1e-4, 1e-4));
  EXPECT_EQ(map.planes.At(1).pi_w.d, before.d);
}

TEST(BundlePlanes, SwitchedOffLeaveThePointsAlone) {
  Map with = WorldWithPlanes(5, 80, ThreePlanes()).map;
  DisturbAll(with, 0.005, 0.003);
  Map without = with;
  for (Keyframe& keyframe : without.keyframes) keyframe.planes.clear();
  const Plane before = with.planes.At(1).pi_w;
  LocalBundleConfig config;
  config.use_planes = false;
  const Camera camera;
  EXPECT_EQ(AdjustLocalBundle(with, 4, camera, FeatureScale{}, config).planes, 0);
  AdjustLocalBundle(without, 4, camera, FeatureScale{}, {});
  for (std::size_t k = 0; k < with.keyframes.size(); ++k) {
    EXPECT_EQ(with.keyframes[k].T_cw.t, without.keyframes[k].T_cw.t);
    EXPECT_EQ(with.keyframes[k].T_cw.R, without.keyframes[k].T_cw.R);
  }
  EXPECT_EQ(with.planes.At(1).pi_w.d, before.d);
}

TEST(BundlePlanes, GiveTheSameBytesTwice) {
  Map first = WorldWithPlanes(5, 80, ThreePlanes()).map;
  DisturbAll(first, 0.005, 0.003);
  Map second = first;
  LocalBundleConfig config;
  config.use_point_planes = true;
  const Camera camera;
  ASSERT_EQ(AdjustLocalBundle(first, 4, camera, FeatureScale{}, config).planes, 3);
  ASSERT_NE(first.keyframes[4].T_cw.t, second.keyframes[4].T_cw.t) << "nothing has moved";
  AdjustLocalBundle(second, 4, camera, FeatureScale{}, config);
  for (std::size_t k = 0; k < first.keyframes.size(); ++k) {
    EXPECT_EQ(first.keyframes[k].T_cw.R, second.keyframes[k].T_cw.R);
    EXPECT_EQ(first.keyframes[k].T_cw.t, second.keyframes[k].T_cw.t);
  }
  for (const MapPlane& plane : first.planes) {
    EXPECT_EQ(plane.pi_w.n, second.planes.At(plane.id).pi_w.n);
    EXPECT_EQ(plane.pi_w.d, second.planes.At(plane.id).pi_w.d);
  }
}

TEST(BundlePlanes, HoldThePointsThatLieOnThemWhenAsked) {
  // A wall of points whose depth is poor, and one point that has come loose from it.
  const Plane wall{Eigen::Vector3d(0, 0, -1), 2.0};
  PointWorld world = MakePointWorld(3, 120, 9);
  Random random{4};
  const int id = AddSeenLandmark(world.map, wall, {0, 0, 2});
  MapPlane& landmark = world.map.planes.At(id);
  for (MapPoint& point : world.map.points) {
    point.p_w.z() = 2.0;
    for (const auto& [keyframe, feature] : point.observations) {
      Keyframe& seen_by = world.map.keyframes[static_cast<std::size_t>(keyframe)];
      PointFeature& seen = seen_by.features[static_cast<std::size_t>(feature)];
      seen = FeatureOfPoint(point.p_w, seen_by.T_cw, world.camera, seen.descriptor, true);
      seen.depth_m += 0.03 * (2 * random.Uniform() - 1);
      seen.depth_sigma_m = 0.03 / std::sqrt(3.0);
    }
    landmark.map_points.insert(point.id);
  }
  const int loose = PointAt(world.map, 1, 0);
  world.map.points[static_cast<std::size_t>(loose)].p_w.z() = 2.1;
  for (const auto& [keyframe, feature] :
       world.map.points[static_cast<std::size_t>(loose)].observations) {
    Keyframe& seen_by = world.map.keyframes[static_cast<std::size_t>(keyframe)];
    PointFeature& seen = seen_by.features[static_cast<std::size_t>(feature)];
    seen = FeatureOfPoint(world.map.points[static_cast<std::size_t>(loose)].p_w, seen_by.T_cw,
                          world.camera, seen.descriptor, true);
  }
  double scatter[2] = {0, 0};
  for (const bool held : {false, true}) {
    Map map = world.map;
    LocalBundleConfig config = ManyIterations();
    config.use_point_planes = held;
    AdjustLocalBundle(map, 2, world.camera, FeatureScale{}, config);
    EXPECT_EQ(map.planes.At(id).map_points.count(loose), held ? 0u : 1u);
    for (const int point : landmark.map_points) {
      if (point == loose) continue;
      scatter[held] += std::abs(SignedDistance(
          map.planes.At(id).pi_w, map.points[static_cast<std::size_t>(point)].p_w));
    }
  }
  EXPECT_LT(scatter[true], 0.5 * scatter[false]);
}

}  // namespace
}  // namespace slam
