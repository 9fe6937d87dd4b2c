#include <gtest/gtest.h>

#include <algorithm>

#include "slam/associate/associate_planes.h"
#include "slam/mapping/plane_fuse.h"
#include "slam/mapping/plane_update.h"
#include "slam/model/map_queries.h"
#include "tests/support/decision_score.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"
#include "tests/support/slam_matchers.h"
#include "tests/support/small_images.h"

namespace slam {
namespace {

/// A desk with books of 9 to 35 mm, one on another, and a phone.
PlaneWorld CrowdedDesk() {
  PlaneWorld world;
  world.Add({0, 0, 0}, {0.8, 0, 0}, {0, 0.45, 0}, "");
  world.AddBox({-0.35, 0.05, 0}, {0.2, 0.25, 0.035}, 0.1, "book");
  world.AddBox({-0.34, 0.06, 0.035}, {0.16, 0.2, 0.015}, 0.25, "book");
  world.AddBox({0.05, 0.1, 0}, {0.4, 0.14, 0.022}, 0.0, "keyboard");
  world.AddBox({0.4, 0.0, 0}, {0.15, 0.21, 0.02}, -0.2, "book");
  world.AddBox({0.05, -0.15, 0}, {0.075, 0.15, 0.009}, 0.4, "cell phone");
  return world;
}

Pose Walk(int k) {
  const double a = 0.08 * k;
  return LookAt({0.5 * std::sin(a), -0.8 + 0.1 * std::cos(1.3 * a), 0.65},
                {0.2 * std::sin(0.9 * a), 0.02, 0});
}

struct WalkResult {
  Map map;
  DecisionScore score;
};

WalkResult MapAWalk(const PlaneWorld& world, const ViewFaults& faults, int frames,
                    AssociationRule rule) {
  WalkResult out;
  const Camera camera = SmallCamera();
  PlaneMapConfig config = SmallImages();
  AssociationConfig association;
  association.rule = rule;
  for (int k = 0; k < frames; ++k) {
    SeenWorld seen =
        See(world, Walk(k), camera, faults, Random{7, static_cast<std::uint64_t>(k)});
    seen.frame.index = k;
    seen.frame.plane_matches =
        AssociatePlanes(seen.frame, out.map, camera, association).matches;
    UpdatePlanes(seen.frame, out.map, camera, association, config);
    if (k % 6 == 5) FusePlanes(out.map, association, config);
    out.score.Count(seen.frame, seen.truth);
  }
  return out;
}

const ViewFaults kNoisy{.depth_noise = 1.0,
                        .miss_rate = 0.3,
                        .box_jitter_px = 1.0,
                        .pose_sigma_m = 0.003,
                        .pose_sigma_rad = 0.002};

TEST(PlaneMap, HoldsEverySurfaceOnceAfterANoisyWalk) {
  const WalkResult walk = MapAWalk(CrowdedDesk(), kNoisy, 40, AssociationRule::kIntegrated);
  EXPECT_GE(walk.score.Precision(), 0.98);
  EXPECT_GE(walk.score.Recall(), 0.95);
  EXPECT_GT(walk.score.true_positives, 150);
}

TEST(PlaneMap, IsClearlyWorseByParametersAlone) {
  const WalkResult walk = MapAWalk(CrowdedDesk(), kNoisy, 40, AssociationRule::kParameters);
  EXPECT_LT(walk.score.Precision(), 0.85);
}

TEST(PlaneMap, IsRightWithoutExceptionOnExactViews) {
  const WalkResult walk = MapAWalk(CrowdedDesk(), {}, 30, AssociationRule::kIntegrated);
  EXPECT_EQ(walk.score.false_positives, 0);
  EXPECT_GT(walk.score.true_positives, 50);
}

TEST(PlaneMap, BelievesTheClassThatIsMissedEveryThirdTime) {
  const PlaneWorld world = CrowdedDesk();
  const WalkResult walk = MapAWalk(world, kNoisy, 40, AssociationRule::kIntegrated);
  int books = 0, desks = 0;
  for (const MapPlane& m : walk.map.planes) {
    if (m.observations < 20 || m.status != LandmarkStatus::kLandmark) continue;
    if (m.area_m2 > 0.3) {
      EXPECT_EQ(m.class_name, "");
      ++desks;
    }
    books += m.class_name == "book" ? 1 : 0;
  }
  EXPECT_GE(books, 3);
  EXPECT_GE(desks, 1);
}

TEST(PlaneMap, LearnsNothingOfClassesFromAFrameInWhichTheDetectorWasNotAsked) {
  const PlaneWorld world = CrowdedDesk();
  const Camera camera = SmallCamera();
  const AssociationConfig association;
  Map map;
  const auto show = [&](int k, bool asked) {
    SeenWorld seen = See(world, Walk(k), camera, {}, Random{7, static_cast<std::uint64_t>(k)});
    seen.frame.index = k;
    seen.frame.detector_asked = asked;
    seen.frame.plane_matches = AssociatePlanes(seen.frame, map, camera, association).matches;
    UpdatePlanes(seen.frame, map, camera, association, SmallImages());
    std::vector<std::map<std::string, double>> beliefs;
    std::vector<int> observations;
    for (const MapPlane& m : map.planes) {
      beliefs.push_back(m.class_belief);
      observations.push_back(m.observations);
    }
    return std::pair(beliefs, observations);
  };
  for (int k = 0; k < 4; ++k) show(k, true);
  const auto before = show(4, true), carried = show(5, false), after = show(6, true);
  ASSERT_EQ(before.first.size(), carried.first.size());
  EXPECT_EQ(before.first, carried.first);
  EXPECT_NE(carried.first, after.first);
  EXPECT_NE(before.second, carried.second) << "the planes themselves are seen";
}

TEST(PlaneMap, KeepsPlanesWithinAMillimetreOfTruthOnExactViews) {
  const PlaneWorld world = CrowdedDesk();
  const WalkResult walk = MapAWalk(world, {}, 20, AssociationRule::kIntegrated);
  int landmarks = 0;
  for (const MapPlane& m : walk.map.planes) {
    if (m.status != LandmarkStatus::kLandmark) continue;
    ++landmarks;
    double nearest = 1.0;
    for (const WorldPlane& truth : world.planes) {
      if (Angle(truth.pi_w().n, m.pi_w.n) > 0.01) continue;
      nearest = std::min(nearest, std::abs(SignedDistance(truth.pi_w(), m.centroid_w)));
    }
    EXPECT_LT(nearest, 1e-3) << m.id;
  }
  EXPECT_GE(landmarks, 3);
}

TEST(PlaneMap, StaysBoundedHoweverOftenAPlaneIsSeen) {
  const WalkResult walk = MapAWalk(CrowdedDesk(), kNoisy, 40, AssociationRule::kIntegrated);
  const PlaneMapConfig config;
  ASSERT_FALSE(walk.map.planes.empty());
  for (const MapPlane& m : walk.map.planes) {
    EXPECT_LE(m.points_w.size(), static_cast<std::size_t>(config.max_cloud_points));
    EXPECT_LE(m.hull_w.size(), 200u);
  }
}

TEST(PlaneMap, StartsNoLandmarkFromAnUndecidedOrFarOrBadPlane) {
  const Camera camera = SmallCamera();
  SeenWorld seen = See(CrowdedDesk(), Walk(0), camera, {}, Random{1});
  ASSERT_GE(seen.frame.planes.size(), 3u);
  seen.frame.plane_matches.assign(seen.frame.planes.size(), {});
  for (PlaneMatch& match : seen.frame.plane_matches) match.reason = MatchReason::kAmbiguous;
  seen.frame.plane_matches[0].reason = MatchReason::kNothing;
  seen.frame.planes[0].centroid_c *= 10.0;
  seen.frame.plane_matches[1].reason = MatchReason::kNothing;
  seen.frame.planes[1].bad = BadReason::kBorder;
  Map map;
  UpdatePlanes(seen.frame, map, camera, {}, SmallImages());
  EXPECT_TRUE(map.planes.empty());
}

TEST(PlaneMap, NotesTheMapPointsThatLieOnASurfaceAndNoneBeforeOrBehindIt) {
  // All were matched on the board's pixels, wherever the map has them.
  const Camera camera = SmallCamera();
  PlaneWorld world;
  world.Add({0, 0, 0}, {0.4, 0, 0}, {0, 0.3, 0}, "");
  Frame frame = See(world, Walk(0), camera, {}, Random{1}).frame;
  const Eigen::Vector3d on_board_w(0.05, 0.02, 0);
  const double most_m = PlaneMapConfig{}.max_point_distance_m;
  Map map;
  for (const double height_m :
       {0.0, 0.9 * most_m, -0.9 * most_m, 1.1 * most_m, -1.1 * most_m, 0.3, -0.3}) {
    MapPoint point;
    point.id = static_cast<int>(map.points.size());
    point.p_w = on_board_w + height_m * Eigen::Vector3d::UnitZ();
    map.points.push_back(point);
    frame.map_points.push_back(point.id);
    frame.features.emplace_back();
    frame.features.back().u_px = camera.Project(frame.T_cw * on_board_w);
  }
  UpdatePlanes(frame, map, camera, {}, SmallImages());
  ASSERT_EQ(Landmarks(map).size(), 1u);
  EXPECT_EQ(Landmarks(map)[0]->map_points, (std::set<int>{0, 1, 2}));
}

/// The landmark that eight frames make of a board at a height.
MapPlane BoardAt(double height_m) {
  const Camera camera = SmallCamera();
  PlaneWorld world;
  world.Add({0, 0, height_m}, {0.4, 0, 0}, {0, 0.3, 0}, "");
  Map single;
  for (int k = 0; k < 8; ++k) {
    SeenWorld seen = See(world, Walk(k), camera, {}, Random{1});
    seen.frame.index = k;
    seen.frame.plane_matches = AssociatePlanes(seen.frame, single, camera, {}).matches;
    UpdatePlanes(seen.frame, single, camera, {}, SmallImages());
  }
  EXPECT_EQ(single.planes.size(), 1u);
  return *single.planes.begin();
}

TEST(PlaneMap, FusesASurfaceThatWasFoundTwiceAndKeepsStepsApart) {
  const PlaneMapConfig config = SmallImages();
  Map map;
  for (const double height_m : {0.0, 0.0, 0.009}) AddLandmark(map, BoardAt(height_m));
  map.planes.At(0).covisible[2] = map.planes.At(2).covisible[0] = 8;
  EXPECT_EQ(FusePlanes(map, {}, config), 1);
  EXPECT_EQ(map.planes.At(1).merged_into, 0);
  EXPECT_EQ(map.planes.At(1).status, LandmarkStatus::kMerged);
  EXPECT_EQ(map.planes.At(2).status, LandmarkStatus::kLandmark);
  EXPECT_EQ(CurrentPlane(map, 1), 0);
  EXPECT_EQ(map.planes.At(0).observations, 16);
  EXPECT_EQ(FusePlanes(map, {}, config), 0);
}

TEST(PlaneMap, FusesWhatAJumpOfThePoseFoundAgainElsewhere) {
  // Many times farther apart than they know; of eight frames that saw each, some saw both.
  struct Case {
    double height_m;
    int together;
    bool fused;
  };
  for (const Case& c : {Case{0.018, 0, true}, Case{0.018, 1, true}, Case{0.018, 2, false},
                        Case{0.018, 8, false}, Case{-0.018, 0, true}, Case{0.06, 0, false}}) {
    SCOPED_TRACE(testing::Message() << c.height_m << " " << c.together);
    Map map;
    for (const double height_m : {0.0, c.height_m}) AddLandmark(map, BoardAt(height_m));
    map.planes.At(0).covisible[1] = map.planes.At(1).covisible[0] = c.together;
    EXPECT_EQ(FusePlanes(map, {}, SmallImages()), c.fused ? 1 : 0);
  }
}

TEST(PlaneMap, FusesWhatWasFoundAgainIfMostOfTheSmallerOneLiesWhereTheLargerOneDoes) {
  // Never seen both. Two thirds of the second one's points lie where the first one is, or one third.
  for (const double shared : {0.67, 0.33}) {
    SCOPED_TRACE(shared);
    Map map;
    for (const double height_m : {0.0, 0.018}) AddLandmark(map, BoardAt(height_m));
    std::vector<double> x_m;
    for (const Eigen::Vector3d& p_w : map.planes.At(1).points_w) x_m.push_back(p_w.x());
    std::sort(x_m.begin(), x_m.end());
    const double end_m = x_m[static_cast<std::size_t>(shared * double(x_m.size()))];
    for (Eigen::Vector3d& p_w : map.planes.At(0).points_w) p_w.x() -= x_m.back() - end_m;
    EXPECT_EQ(FusePlanes(map, {}, SmallImages()), shared > 0.5 ? 1 : 0);
  }
}

TEST(PlaneMap, KeepsFrontsApartThatLieOneAboveTheOther) {
  // As two books of a stack: strips that come within a voxel of each other, never seen both.
  Map map;
  for (const double height_m : {0.0, 0.018}) AddLandmark(map, BoardAt(height_m));
  MapPlane &lower = map.planes.At(0), &upper = map.planes.At(1);
  const double density = static_cast<double>(lower.points_w.size()) / lower.area_m2;
  std::erase_if(lower.points_w, [](const auto& p_w) { return p_w.y() > 0.0; });
  std::erase_if(upper.points_w,
                [](const auto& p_w) { return p_w.y() < 0.0 || p_w.y() > 0.03; });
  for (MapPlane* strip : {&lower, &upper}) {
    ASSERT_FALSE(strip->points_w.empty());
    strip->area_m2 = static_cast<double>(strip->points_w.size()) / density;
  }
  EXPECT_EQ(FusePlanes(map, {}, SmallImages()), 0);
}

TEST(PlaneMap, DoesNotFuseSurfacesBetweenWhichAStepWasSeen) {
  // Two landmarks that agree; of the frames that saw both, some or most showed a step.
  for (const int steps : {1, 6, 12}) {
    SCOPED_TRACE(steps);
    Map map;
    for (int twice = 0; twice < 2; ++twice) AddLandmark(map, BoardAt(0));
    map.planes.At(0).covisible[1] = map.planes.At(1).covisible[0] = 12;
    map.planes.At(0).stepped[1] = map.planes.At(1).stepped[0] = steps;
    EXPECT_EQ(FusePlanes(map, {}, SmallImages()), steps > 6 ? 0 : 1);
  }
}

TEST(PlaneMap, CountsForAFusedSurfaceWhatWasCountedOfBoth) {
  Map map;
  for (const double height_m : {0.0, 0.0, 0.1}) AddLandmark(map, BoardAt(height_m));
  MapPlane &first = map.planes.At(0), &second = map.planes.At(1), &board = map.planes.At(2);
  first.covisible = {{1, 2}, {2, 3}}, first.stepped = {{2, 1}};
  second.covisible = {{0, 2}, {2, 4}}, second.stepped = {{2, 2}};
  first.observations = 10, second.observations = 6;
  first.seen_px = 1000, second.seen_px = 600;
  board.covisible = {{0, 3}, {1, 4}}, board.stepped = {{0, 1}, {1, 2}};
  first.class_belief = {{"", 1.0}, {"book", 2.0}}, second.class_belief = {{"book", 3.0}};
  ASSERT_EQ(FusePlanes(map, {}, SmallImages()), 1);
  ASSERT_EQ(second.merged_into, 0);
  EXPECT_DOUBLE_EQ(first.class_belief.at("book"), 5.0);
  EXPECT_DOUBLE_EQ(first.class_belief.at(""), 1.0);
  EXPECT_EQ(first.class_name, "book");
  EXPECT_EQ(first.covisible, (std::map<int, int>{{2, 7}}));
  EXPECT_EQ(first.stepped, (std::map<int, int>{{2, 3}}));
  EXPECT_EQ(board.covisible, (std::map<int, int>{{0, 7}}));
  EXPECT_EQ(board.stepped, (std::map<int, int>{{0, 3}}));
  EXPECT_EQ(first.observations, 14);  // frames: two showed both
  EXPECT_EQ(first.seen_px, 1600);
}

TEST(PlaneMap, KnowsWhereAFusedSurfaceLiesAndWhatWasSupposedAtItsEdges) {
  // Two ends of a board, of which the second has corners that are better known, 2 mm beside the plane.
  Map map;
  MapPlane left = BoardAt(0.0), right = left;
  std::erase_if(left.points_w, [](const Eigen::Vector3d& p_w) { return p_w.x() > 0.1; });
  std::erase_if(right.points_w, [](const Eigen::Vector3d& p_w) { return p_w.x() < -0.1; });
  left.centroid_w = {-0.1, 0, 0}, right.centroid_w = {0.1, 0, 0};
  right.vertices_w = {{0.2, 0.15, 0.002}}, right.vertex_weights = {5.0};
  right.supposed = {SupposedPlane{}};
  AddLandmark(map, left), AddLandmark(map, right);
  ASSERT_EQ(FusePlanes(map, {}, SmallImages()), 1);
  const MapPlane &whole = map.planes.At(0), &gone = map.planes.At(1);
  EXPECT_NEAR(whole.centroid_w.x(), 0.0, 0.02);
  EXPECT_NEAR(SignedDistance(whole.pi_w, whole.vertices_w.at(0)), 0.0, 1e-9);
  EXPECT_EQ(whole.vertex_weights, right.vertex_weights);
  EXPECT_EQ(whole.supposed.size(), 1u);
  EXPECT_TRUE(gone.supposed.empty());
}

// Whichever is the older one.
TEST(PlaneMap, KnowsWhereAFusedSurfaceLiesInTheWorldAsItsFramesTogetherKnewTheirPlace) {
  for (const bool better_known_first : {true, false}) {
    SCOPED_TRACE(better_known_first);
    MapPlane here = BoardAt(0.0), far_off = here;
    here.estimate.world_variance_m2 = 1e-6;
    far_off.estimate.world_variance_m2 = 9e-6;
    // Three times as many frames saw it from there.
    far_off.estimate.information *= 3, far_off.estimate.weighted *= 3;
    Map map;
    AddLandmark(map, better_known_first ? here : far_off);
    AddLandmark(map, better_known_first ? far_off : here);
    ASSERT_EQ(FusePlanes(map, {}, SmallImages()), 1);
    EXPECT_NEAR(map.planes.At(0).estimate.world_variance_m2, (1e-6 + 3 * 9e-6) / 4, 1e-9);
  }
}

TEST(PlaneMap, NotesTheStepsThatAFrameShowsBetweenItsLandmarks) {
  // A desk and a board on it that touch in the image: their parameters alone could be one.
  const Camera camera = SmallCamera();
  PlaneWorld world;
  world.Add({-0.2, 0, 0}, {0.2, 0, 0}, {0, 0.3, 0}, "");
  world.Add({0.2, 0, 0.03}, {0.2, 0, 0}, {0, 0.3, 0}, "");
  Map map;
  for (int k = 0; k < 3; ++k) {
    SeenWorld seen = See(world, Walk(k), camera, {}, Random{1});
    seen.frame.index = k;
    seen.frame.plane_matches = AssociatePlanes(seen.frame, map, camera, {}).matches;
    if (k > 0) seen.frame.plane_steps = {{0, 1}};
    UpdatePlanes(seen.frame, map, camera, {}, SmallImages());
  }
  ASSERT_EQ(map.planes.size(), 2u);
  EXPECT_EQ(map.planes.At(0).stepped.at(1), 2);
  EXPECT_EQ(map.planes.At(1).stepped.at(0), 2);
}

TEST(PlaneMap, CountsStepsOfFramesInWhichBothAreLandmarks) {
  // The board comes later and is on trial first: what frames show of a candidate is no step between
  // landmarks, of which as many frames with both must be counted.
  const Camera camera = SmallCamera();
  PlaneWorld alone, both;
  alone.Add({-0.2, 0, 0}, {0.2, 0, 0}, {0, 0.3, 0}, "");
  both = alone;
  both.Add({0.2, 0, 0.03}, {0.2, 0, 0}, {0, 0.3, 0}, "");
  Map map;
  for (int k = 0; k < 6; ++k) {
    SeenWorld seen = See(k == 0 ? alone : both, Walk(k), camera, {}, Random{1});
    seen.frame.index = k;
    seen.frame.plane_matches = AssociatePlanes(seen.frame, map, camera, {}).matches;
    if (k > 0) seen.frame.plane_steps = {{0, 1}};
    UpdatePlanes(seen.frame, map, camera, {}, SmallImages());
  }
  ASSERT_EQ(Landmarks(map).size(), 2u);
  EXPECT_LT(map.planes.At(0).covisible.at(1), 5);
  EXPECT_EQ(map.planes.At(0).stepped, map.planes.At(0).covisible);
}

}  // namespace
}  // namespace slam
