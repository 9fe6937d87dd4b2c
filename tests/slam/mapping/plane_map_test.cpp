#include <gtest/gtest.h>

#include "slam/associate/associate_planes.h"
#include "slam/mapping/plane_cloud.h"
#include "slam/mapping/plane_fuse.h"
#include "slam/mapping/plane_update.h"
#include "slam/mapping/plane_vertices.h"
#include "slam/model/class_belief.h"
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
}

TEST(PlaneMap, BelievesTheClassThatIsMissedEveryThirdTime) {
  const PlaneWorld world = CrowdedDesk();
  const WalkResult walk = MapAWalk(world, kNoisy, 40, AssociationRule::kIntegrated);
  int books = 0;
  for (const MapPlane& m : walk.map.planes) {
    if (m.observations < 20 || m.status != LandmarkStatus::kLandmark) continue;
    if (m.area_m2 > 0.3) {
      EXPECT_EQ(m.class_name, "");
    }
    books += m.class_name == "book" ? 1 : 0;
  }
  EXPECT_GE(books, 3);
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
  for (const MapPlane& m : walk.map.planes) {
    if (m.status != LandmarkStatus::kLandmark) continue;
    double nearest = 1.0;
    for (const WorldPlane& truth : world.planes) {
      if (Angle(truth.pi_w().n, m.pi_w.n) > 0.01) continue;
      nearest = std::min(nearest, std::abs(SignedDistance(truth.pi_w(), m.centroid_w)));
    }
    EXPECT_LT(nearest, 1e-3) << m.id;
  }
}

TEST(PlaneMap, StaysBoundedHoweverOftenAPlaneIsSeen) {
  const WalkResult walk = MapAWalk(CrowdedDesk(), kNoisy, 40, AssociationRule::kIntegrated);
  const PlaneMapConfig config;
  for (const MapPlane& m : walk.map.planes) {
    EXPECT_LE(m.points_w.size(), static_cast<std::size_t>(config.max_cloud_points));
    EXPECT_LE(m.edge_points_w.size(), static_cast<std::size_t>(config.max_edge_points));
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
  EXPECT_EQ(FusePlanes(map, {}, config), 1);
  EXPECT_EQ(map.planes.At(1).merged_into, 0);
  EXPECT_EQ(map.planes.At(1).status, LandmarkStatus::kMerged);
  EXPECT_EQ(map.planes.At(2).status, LandmarkStatus::kLandmark);
  EXPECT_EQ(CurrentPlane(map, 1), 0);
  EXPECT_EQ(map.planes.At(0).observations, 16);
  EXPECT_EQ(FusePlanes(map, {}, config), 0);
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
  first.covisible = {{2, 3}}, first.stepped = {{2, 1}};
  second.covisible = {{2, 4}}, second.stepped = {{2, 2}};
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

TEST(ClassBelief, IsNotTheFirstLabel) {
  MapPlane m;
  UpdateClassBelief(m, "keyboard", 0.9);
  for (int i = 0; i < 6; ++i) UpdateClassBelief(m, "book", 0.9);
  EXPECT_EQ(m.class_name, "book");
}

TEST(ClassBelief, SurvivesMissesButNotAMajorityOfThem) {
  MapPlane m;
  for (int i = 0; i < 4; ++i) UpdateClassBelief(m, "book", 0.9);
  for (int i = 0; i < 4; ++i) UpdateClassBelief(m, "", 1);
  EXPECT_EQ(m.class_name, "book");
  MapPlane desk;
  for (int i = 0; i < 12; ++i) UpdateClassBelief(desk, "", 1);
  UpdateClassBelief(desk, "book", 0.9);
  EXPECT_EQ(desk.class_name, "");
}

TEST(PlaneVertices, AreAveragedWhateverCornerTheObservationStartsWith) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Eigen::Vector3d> truth{{0, 0, 0}, {0.2, 0, 0}, {0.2, 0.1, 0}, {0, 0.1, 0}};
  Random random{5};
  for (std::size_t k = 0; k < 40; ++k) {
    std::vector<Vertex> seen(4);
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t from = k % 2 == 0 ? (i + k) % 4 : (8 + k - i) % 4;
      seen[i].p_c = truth[from] + 0.002 * Eigen::Vector3d(Normal(random), Normal(random), 0);
    }
    FuseVertices(m, seen, Pose{}, {});
  }
  ASSERT_EQ(m.vertices_w.size(), 4u);
  for (const Eigen::Vector3d& v_w : m.vertices_w) {
    double nearest = 1.0;
    for (const Eigen::Vector3d& t_w : truth) nearest = std::min(nearest, (t_w - v_w).norm());
    EXPECT_LT(nearest, 0.002);  // 0.3 mm expected of the mean of forty, with a wide margin
  }
}

TEST(PlaneVertices, LeanOnThoseThatAreKnownBetterWithinThePlane) {
  const auto fused_x = [](const Eigen::Matrix3d& covariance_c) {
    MapPlane m;
    m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
    std::vector<Vertex> seen{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
    FuseVertices(m, seen, Pose{}, {});
    for (Vertex& v : seen) v.p_c.x() += 0.01, v.covariance_c = covariance_c;
    FuseVertices(m, seen, Pose{}, {});
    return m.vertices_w[0].x();
  };
  const Eigen::Matrix3d large = 1e-4 * Eigen::Matrix3d::Identity();
  EXPECT_NEAR(fused_x(Eigen::Matrix3d::Zero()), 0.005, 1e-12);
  EXPECT_NEAR(fused_x(large), 0.01 * (9.0 / 109.0) / (1.0 + 9.0 / 109.0), 1e-12);
  // Depth that is not known says nothing against where the plane's sides meet ...
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ(), slanted(1, 0, 1);
  EXPECT_NEAR(fused_x(1e-4 * z * z.transpose()), 0.005, 1e-12);
  // ... nor does an error along a slanted ray: the plane says where on it the corner is.
  EXPECT_NEAR(fused_x(1e-4 * slanted * slanted.transpose()), 0.005, 1e-12);
}

TEST(ClassBelief, CountsADetectionByItsScoreAndAMissAsAFullFrame) {
  MapPlane plane;
  for (int i = 0; i < 2; ++i) {
    UpdateClassBelief(plane, "", 0.3);
    UpdateClassBelief(plane, "book", 0.7);
    UpdateClassBelief(plane, "cup", 0.01);
  }
  EXPECT_DOUBLE_EQ(plane.class_belief.at(""), 2.0);
  EXPECT_DOUBLE_EQ(plane.class_belief.at("book"), 1.4);
  EXPECT_DOUBLE_EQ(plane.class_belief.at("cup"), 0.2);  // what was reported is some evidence
}

TEST(PlaneVertices, StayThroughASingleWrongCornerAndCanBeLeftHoweverOftenTheyWereSeen) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Vertex> usual{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  std::vector<Vertex> other = usual;
  other[1].p_c.x() = 0.3;
  for (int i = 0; i < 500; ++i) FuseVertices(m, usual, Pose{}, {});
  FuseVertices(m, other, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(usual[1].p_c, 1e-9));
  for (int i = 0; i < 40; ++i) FuseVertices(m, other, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(other[1].p_c, 1e-9));
}

TEST(PlaneVertices, CountAnExtrapolatedCornerAsAQuarterOfASeenOne) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> seen{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  FuseVertices(m, seen, Pose{}, {});
  for (Vertex& vertex : seen) vertex.extrapolated = true, vertex.p_c.x() += 0.01;
  FuseVertices(m, seen, Pose{}, {});
  EXPECT_THAT(m.vertices_w[0], VectorNear(Eigen::Vector3d(0.01 * 0.25 / 1.25, 0, 0), 1e-12));
  EXPECT_DOUBLE_EQ(m.vertex_weights[0], 1.25);
}

TEST(PlaneVertices, WeighEachCornerByItsOwnObservationWhereverThatStands) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> seen{{{0, 0, 0}}, {{0.2, 0, 0}}, {{0.2, 0.1, 0}}, {{0, 0.1, 0}}};
  FuseVertices(m, seen, Pose{}, {});
  seen[1].extrapolated = true;
  for (Vertex& vertex : seen) vertex.p_c.x() += 0.01;
  std::reverse(seen.begin(), seen.end());
  FuseVertices(m, seen, Pose{}, {});
  EXPECT_EQ(m.vertex_weights, std::vector<double>({2, 1.25, 2, 2}));
  EXPECT_NEAR(m.vertices_w[1].x(), 0.2 + 0.01 * 0.25 / 1.25, 1e-12);
  EXPECT_NEAR(m.vertices_w[2].x(), 0.2 + 0.01 / 2, 1e-12);
}

TEST(PlaneVertices, AreBorneOutByCornersOfAFaceSeenInPart) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  const std::vector<Vertex> whole{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
  const std::vector<Vertex> part{{{0.31, 0.1, 0.002}}, {{0.1, 0, 0}}};
  FuseVertices(m, part, Pose{}, {});
  EXPECT_TRUE(m.vertices_w.empty());  // a part starts nothing
  FuseVertices(m, whole, Pose{}, {});
  FuseVertices(m, part, Pose{}, {});
  EXPECT_THAT(m.vertices_w[2], VectorNear(Eigen::Vector3d(0.305, 0.1, 0), 1e-12));
  EXPECT_EQ(m.vertex_weights, std::vector<double>({1, 1, 2, 1}));  // the other is at none
  std::vector<Vertex> guessed = part;
  guessed[0].extrapolated = true;
  FuseVertices(m, guessed, Pose{}, {});
  EXPECT_EQ(m.vertex_weights, std::vector<double>({1, 1, 2, 1}));
}

TEST(PlaneVertices, ArePoorlyBorneOutByWhatATurnedCameraKnowsPoorlyWithinThePlane) {
  // The plane's normal is the camera's x; depth, which lies in the plane, is what it errs in.
  Pose T_wc;
  T_wc.R << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const std::vector<Eigen::Vector3d> corners_w{
      {0, 0, 0}, {0.3, 0, 0}, {0.3, 0.1, 0}, {0, 0.1, 0}};
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> seen(4);
  for (std::size_t i = 0; i < 4; ++i) seen[i].p_c = Inverse(T_wc) * corners_w[i];
  FuseVertices(m, seen, T_wc, {});
  seen.resize(2);
  for (Vertex& vertex : seen) {
    vertex.covariance_c(0, 0) = 1e-4;  // which the plane takes away
    vertex.covariance_c(2, 2) = 2e-4;  // 10 mm, as the mean of two directions
  }
  FuseVertices(m, seen, T_wc, {});
  EXPECT_NEAR(m.vertex_weights[0], 1 + 9.0 / 109.0, 1e-12);
  EXPECT_NEAR(m.vertex_weights[2], 1, 1e-12);
}

TEST(PlaneVertices, LeaveAWrongStartOnceTheEvidenceIsAgainstIt) {
  MapPlane m;
  m.pi_w = {Eigen::Vector3d::UnitZ(), 0};
  std::vector<Vertex> cut{{{0, 0, 0}}, {{0.1, 0, 0}}, {{0.1, 0.1, 0}}, {{0, 0.1, 0}}};
  std::vector<Vertex> whole{{{0, 0, 0}}, {{0.3, 0, 0}}, {{0.3, 0.1, 0}}, {{0, 0.1, 0}}};
  for (int i = 0; i < 2; ++i) FuseVertices(m, cut, Pose{}, {});
  std::vector<Vertex> from_another_side = whole;  // seen corners start anywhere
  std::rotate(from_another_side.begin(), from_another_side.begin() + 1,
              from_another_side.end());
  for (int i = 0; i < 5; ++i) FuseVertices(m, from_another_side, Pose{}, {});
  EXPECT_THAT(m.vertices_w[1], VectorNear(whole[1].p_c, 1e-9));
  EXPECT_THAT(m.vertices_w[2], VectorNear(whole[2].p_c, 1e-9));
}

TEST(PlaneCloud, OverlapsWhereItLiesAndNotWhereItIsOfOneShape) {
  const Plane pi_w{Eigen::Vector3d(0.6, 0, 0.8), 0.0};
  const auto patch = [&](double along_m, int cells) {
    std::vector<Eigen::Vector3d> points;
    for (int x = 0; x < cells; ++x) {
      for (int y = 0; y < 10; ++y) {
        points.push_back(Eigen::Vector3d(0.8, 0, -0.6) * (along_m + 0.05 * x) +
                         Eigen::Vector3d(0, 0.05 * y, 0));
      }
    }
    return points;
  };
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(0, 10), pi_w, 0.05, 0), 1.0);
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(2, 10), pi_w, 0.05, 0), 0.0);
  // The last five rows of the one are the first of the other, or the whole of it.
  EXPECT_EQ(CloudOverlap(patch(0, 10), patch(0.25, 10), pi_w, 0.05, 0), 0.5);
  EXPECT_EQ(CloudOverlap(patch(0.25, 5), patch(0, 10), pi_w, 0.05, 0), 1.0);
}

TEST(PlaneCloud, OutlineOfASquareHasItsArea) {
  std::vector<Eigen::Vector3d> points;
  for (int x = 0; x <= 10; ++x) {
    for (int y = 0; y <= 10; ++y) points.emplace_back(0.1 * x, 0.1 * y, 2.0);
  }
  const Outline outline = ConvexOutline(points, {Eigen::Vector3d::UnitZ(), -2.0});
  EXPECT_EQ(outline.hull_w.size(), 4u);
  EXPECT_NEAR(outline.area_m2, 1.0, 1e-12);
  EXPECT_TRUE(ConvexOutline({{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}, {Eigen::Vector3d::UnitZ(), 0})
                  .hull_w.empty());
}

}  // namespace
}  // namespace slam
