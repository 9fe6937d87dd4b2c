#include "slam/associate/associate_planes.h"

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "slam/associate/correct_prediction.h"
#include "slam/associate/pair_evidence.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

constexpr double kDesk = 0.8;

PlaneMapConfig SmallImages() {
  PlaneMapConfig config;
  config.trial_pixels = 480;
  config.trial_frames = 1;  // one view is the map
  return config;
}

/// A desk with a book of this thickness in its middle, class or none.
PlaneWorld DeskWithBook(double step_m, const char* class_name) {
  PlaneWorld world;
  world.Add({0, 0, 0}, {kDesk, 0, 0}, {0, 0.5, 0}, "");
  world.AddBox({0, 0, 0}, {0.2, 0.25, step_m}, 0.2, class_name);
  return world;
}

const Pose kFirst = LookAt({0, -0.8, 0.7}, {0, 0, 0});
const Pose kSecond = LookAt({0.15, -0.75, 0.65}, {0.02, 0, 0});

struct Association {
  Map map;
  SeenWorld first, second;
};

/// Maps one view and associates another.
Association TwoViews(const PlaneWorld& world, const ViewFaults& faults,
                     AssociationConfig config) {
  Association out;
  const Camera camera = SmallCamera();
  out.first = See(world, kFirst, camera, {.depth_noise = faults.depth_noise}, Random{1});
  UpdatePlanes(out.first.frame, out.map, camera, {}, SmallImages());
  out.second = See(world, kSecond, camera, faults, Random{2});
  out.second.frame.plane_matches =
      AssociatePlanes(out.second.frame, out.map, camera, config).matches;
  return out;
}

/// Truth of the landmark that a frame plane of the second view was matched with; -1 for none.
int Landmark(const Association& a, std::size_t f) {
  const PlaneMatch& match = a.second.frame.plane_matches[f];
  if (match.decision != PlaneDecision::kMatched) return -1;
  for (std::size_t g = 0; g < a.first.truth.size(); ++g) {
    if (a.first.frame.plane_matches[g].map_plane == match.map_plane) return a.first.truth[g];
  }
  return -2;
}

void ExpectAllRight(const Association& a) {
  ASSERT_FALSE(a.second.truth.empty());
  for (std::size_t f = 0; f < a.second.truth.size(); ++f) {
    EXPECT_EQ(Landmark(a, f), a.second.truth[f]) << "frame plane " << f;
  }
}

TEST(PlaneAssociation, TellsABookFromTheDeskItLiesOn) {
  for (const double step : {0.005, 0.01, 0.02, 0.05}) {
    SCOPED_TRACE(step);
    ExpectAllRight(TwoViews(DeskWithBook(step, "book"), {}, {}));
  }
}

TEST(PlaneAssociation, NeedsNoDetectionToTellThemApart) {
  ExpectAllRight(TwoViews(DeskWithBook(0.01, "book"), {.miss_rate = 1.0}, {}));
  ExpectAllRight(TwoViews(DeskWithBook(0.01, ""), {.depth_noise = 1.0}, {}));
}

TEST(PlaneAssociation, CorrectsAPoseThatIsOffByTheStepItself) {
  // Eight millimetres of error along the normal would turn the desk into the book's top.
  ExpectAllRight(TwoViews(DeskWithBook(0.008, "book"),
                          {.pose_sigma_m = 0.004, .pose_sigma_rad = 0.002}, {}));
}

TEST(PlaneAssociation, ByParametersAloneTakesTheBookForTheDeskOrTheDeskForTheBook) {
  const ViewFaults faults{.depth_noise = 1.0, .pose_sigma_m = 0.006, .pose_sigma_rad = 0.004};
  AssociationConfig parameters;
  parameters.rule = AssociationRule::kParameters;
  int wrong = 0, wrong_integrated = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Camera camera = SmallCamera();
    Association a;
    const PlaneWorld world = DeskWithBook(0.008, "book");
    a.first = See(world, kFirst, camera, {}, Random{1});
    UpdatePlanes(a.first.frame, a.map, camera, {}, SmallImages());
    a.second = See(world, kSecond, camera, faults, Random{2, seed});
    for (const bool integrated : {false, true}) {
      a.second.frame.plane_matches =
          AssociatePlanes(a.second.frame, a.map, camera,
                          integrated ? AssociationConfig{} : parameters)
              .matches;
      for (std::size_t f = 0; f < a.second.truth.size(); ++f) {
        const int landmark = Landmark(a, f);
        if (landmark < 0 || landmark == a.second.truth[f]) continue;
        ++(integrated ? wrong_integrated : wrong);
      }
    }
  }
  EXPECT_GT(wrong, 0);
  EXPECT_EQ(wrong_integrated, 0);
}

TEST(PlaneAssociation, ByParametersAloneFindsEachSurfaceAgainAndLeavesOutWhatIsBad) {
  AssociationConfig parameters;
  parameters.rule = AssociationRule::kParameters;
  Association a = TwoViews(DeskWithBook(0.05, "book"), {}, parameters);
  ExpectAllRight(a);
  for (FramePlane& plane : a.second.frame.planes) plane.bad = BadReason::kFar;
  for (const PlaneMatch& match :
       AssociatePlanes(a.second.frame, a.map, SmallCamera(), parameters).matches)
    EXPECT_EQ(match.decision, PlaneDecision::kUnmatched);
}

TEST(PlaneAssociation, DoesNotTakeOneTopForAnotherOfTheSameHeight) {
  PlaneWorld world;
  world.AddBox({-0.25, 0, 0}, {0.2, 0.25, 0.03}, 0, "book");
  PlaneWorld both = world;
  both.AddBox({0.25, 0, 0}, {0.2, 0.25, 0.03}, 0, "book");
  const Camera camera = SmallCamera();
  Map map;
  SeenWorld first = See(world, kFirst, camera, {}, Random{1});
  UpdatePlanes(first.frame, map, camera, {}, SmallImages());
  SeenWorld second = See(both, kSecond, camera, {}, Random{2});
  second.frame.plane_matches = AssociatePlanes(second.frame, map, camera, {}).matches;
  ASSERT_TRUE(std::any_of(second.truth.begin(), second.truth.end(),
                          [](int shown) { return shown >= 5; }));
  for (std::size_t f = 0; f < second.truth.size(); ++f) {
    if (second.truth[f] < 5) continue;  // of the first book
    EXPECT_NE(second.frame.plane_matches[f].decision, PlaneDecision::kMatched)
        << second.truth[f];
  }
}

TEST(PlaneAssociation, ADeskBesideOneThatIsAsHighIsAnotherOne) {
  PlaneWorld left, right;
  left.Add({-0.4, 0, 0}, {0.35, 0, 0}, {0, 0.5, 0}, "");
  right.Add({0.4, 0, 0}, {0.35, 0, 0}, {0, 0.5, 0}, "");
  const Camera camera = SmallCamera();
  Map map;
  SeenWorld first = See(left, LookAt({-0.3, -0.6, 0.4}, {-0.3, 0, 0}), camera, {}, Random{1});
  UpdatePlanes(first.frame, map, camera, {}, SmallImages());
  SeenWorld second = See(right, LookAt({0.3, -0.6, 0.4}, {0.3, 0, 0}), camera, {}, Random{2});
  second.frame.plane_matches = AssociatePlanes(second.frame, map, camera, {}).matches;
  ASSERT_EQ(second.truth.size(), 1u);
  EXPECT_NE(second.frame.plane_matches[0].decision, PlaneDecision::kMatched);
}

TEST(PlaneAssociation, MatchesBothPiecesOfASurfaceThatIsCutInTwo) {
  PlaneWorld whole = DeskWithBook(0.02, "book"), cut = whole;
  cut.AddBox({0, 0.05, 0}, {0.06, 1.2, 0.1}, 0, "box");
  const Camera camera = SmallCamera();
  Map map;
  SeenWorld first = See(whole, kFirst, camera, {}, Random{1});
  UpdatePlanes(first.frame, map, camera, {}, SmallImages());
  SeenWorld second = See(cut, kFirst, camera, {}, Random{2});
  second.frame.plane_matches = AssociatePlanes(second.frame, map, camera, {}).matches;
  int desk_pieces = 0, matched = 0;
  for (std::size_t f = 0; f < second.truth.size(); ++f) {
    if (second.truth[f] != 0) continue;
    ++desk_pieces;
    matched += second.frame.plane_matches[f].decision == PlaneDecision::kMatched ? 1 : 0;
  }
  EXPECT_GE(desk_pieces, 2);
  EXPECT_EQ(matched, desk_pieces);
}

/// Has a map plane be known so well, where it is.
void KnowTo(MapPlane& m, double sigma_m, double sigma_rad) {
  const Eigen::Vector3d at = m.estimate.information.ldlt().solve(m.estimate.weighted);
  const Eigen::Vector3d sigmas(sigma_m, sigma_rad, sigma_rad);
  m.estimate.information = sigmas.cwiseAbs2().cwiseInverse().asDiagonal();
  m.estimate.weighted = m.estimate.information * at;
}

TEST(PlaneAssociation, ACandidateThatIsALandmarkFoundTwiceTakesNothingFromIt) {
  // The copy on trial explains the frame clearly better, by 5 mm under a pose that is known well:
  // it is still the landmark's surface.
  const Camera camera = SmallCamera();
  const AssociationConfig config;
  Association a = TwoViews(DeskWithBook(0.02, ""), {}, config);
  a.second.frame.pose_covariance = 0.0005 * 0.0005 * Matrix6d::Identity();
  const int desk = a.first.frame.plane_matches[0].map_plane;
  KnowTo(a.map.planes.At(desk), 0.0012, 0.006);
  MapPlane copy = a.map.planes.At(desk);
  copy.status = LandmarkStatus::kCandidate;
  a.map.planes.Add(copy);
  a.map.planes.At(desk).pi_w.d += 0.005;
  a.second.frame.plane_matches = AssociatePlanes(a.second.frame, a.map, camera, config).matches;
  ExpectAllRight(a);
}

TEST(PlaneAssociation, AStripThatIsKnownPoorlyDoesNotTakeTheSurfaceThatItIsAPartOf) {
  // Both miss what is seen by the same 3 mm, and where little is known that says less: by the
  // chi-square alone the strip would be nearer.
  const Camera camera = SmallCamera();
  const AssociationConfig config;
  Association a = TwoViews(DeskWithBook(0.02, ""), {}, config);
  a.second.frame.pose_covariance = 0.0005 * 0.0005 * Matrix6d::Identity();
  const int desk = a.first.frame.plane_matches[0].map_plane;
  a.map.planes.At(desk).pi_w.d += 0.003;
  MapPlane strip = a.map.planes.At(desk);
  KnowTo(strip, 0.008, 0.04);
  a.map.planes.Add(strip);
  const UncertainPose pose = PredictedPose(a.second.frame);
  PairRefusals refused;
  const PairTable pairs =
      WeighPairs(a.second.frame, a.map, pose, pose, camera, config, refused);
  const PairEvidence *of_desk = nullptr, *of_strip = nullptr;
  for (const PairEvidence& pair : pairs[0]) {
    if (pair.verdict != PairVerdict::kPossible) continue;
    (pair.map_plane == desk ? of_desk : of_strip) = &pair;
  }
  ASSERT_TRUE(of_desk != nullptr && of_strip != nullptr);
  ASSERT_GT(of_desk->parameter_cost, of_strip->parameter_cost + 0.1);
  const auto matches = AssociatePlanes(a.second.frame, a.map, camera, config).matches;
  EXPECT_EQ(matches[0].map_plane, desk);
  EXPECT_EQ(matches[0].decision, PlaneDecision::kMatched);
}

/// The segment of a frame's first plane takes in that of another.
void TakeIn(Frame& frame, std::size_t other) {
  FramePlane &into = frame.planes[0], &from = frame.planes[other];
  frame.plane_labels.setTo(1, frame.plane_labels == from.index + 1);
  into.points_c.insert(into.points_c.end(), from.points_c.begin(), from.points_c.end());
  into.pixel_count += from.pixel_count, into.area_m2 += from.area_m2;
  from.bad = BadReason::kInliers;
}

TEST(PlaneAssociation, ASegmentThatTookInABookIsTheDeskWhoseShareOfItIsLarger) {
  // The book's landmark fits as well, and a step was often seen between the two.
  Association a = TwoViews(DeskWithBook(0.003, ""), {}, {});
  const int desk = a.first.frame.plane_matches[0].map_plane;
  const int book = a.first.frame.plane_matches[1].map_plane;
  ASSERT_TRUE(a.second.truth[0] == 0 && a.second.truth[1] == 1 && desk != book);
  constexpr int kFrames = 10;
  for (const auto& [one, other] : {std::pair(desk, book), std::pair(book, desk)}) {
    a.map.planes.At(one).covisible[other] = kFrames;
    a.map.planes.At(one).stepped[other] = kFrames;
  }
  const double times = static_cast<double>(a.second.frame.planes[0].pixel_count) /
                       a.second.frame.planes[1].pixel_count;
  TakeIn(a.second.frame, 1);
  const UncertainPose pose = PredictedPose(a.second.frame);
  PairRefusals refused;
  const PairTable pairs =
      WeighPairs(a.second.frame, a.map, pose, pose, SmallCamera(), {}, refused);
  const auto evidence = [&](int landmark) {
    const auto found =
        std::find_if(pairs[0].begin(), pairs[0].end(),
                     [&](const PairEvidence& pair) { return pair.map_plane == landmark; });
    return found == pairs[0].end() ? PairEvidence{} : *found;
  };
  ASSERT_EQ(evidence(desk).verdict, PairVerdict::kPossible);
  ASSERT_EQ(evidence(book).verdict, PairVerdict::kPossible);
  EXPECT_EQ(evidence(desk).share_cost, 0.0);
  EXPECT_NEAR(evidence(book).share_cost, 2.0 * std::log(times), 0.5);
  const auto matches = AssociatePlanes(a.second.frame, a.map, SmallCamera(), {}).matches;
  EXPECT_EQ(matches[0].decision, PlaneDecision::kMatched);
  EXPECT_EQ(matches[0].map_plane, desk);
  EXPECT_EQ(matches[0].reason, MatchReason::kOverlap);
}

/// Part of a frame's first plane as a plane of its own, nearer by a step of 4 mm that bends may
/// explain.
void TearOff(Frame& frame, const cv::Rect& where) {
  FramePlane& whole = frame.planes[0];
  FramePlane piece = whole;
  piece.index = static_cast<int>(frame.planes.size());
  piece.points_c.clear(), piece.edge_points.clear();
  piece.pi_c.d -= 0.004;
  for (int v = where.y; v < where.br().y; ++v) {
    for (int u = where.x; u < where.br().x; ++u) {
      if (frame.plane_labels(v, u) != 1) continue;
      const Eigen::Vector3d ray = SmallCamera().Backproject({u, v}, 1.0);
      const double z = -piece.pi_c.d / piece.pi_c.n.dot(ray);
      frame.plane_labels(v, u) = static_cast<std::uint8_t>(piece.index + 1);
      frame.depth_m(v, u) = static_cast<float>(z);
      piece.points_c.emplace_back(z * ray);
    }
  }
  piece.pixel_count = static_cast<int>(piece.points_c.size());
  piece.centroid_c =
      std::accumulate(piece.points_c.begin(), piece.points_c.end(), Eigen::Vector3d(0, 0, 0)) /
      piece.pixel_count;
  piece.area_m2 *= static_cast<double>(piece.pixel_count) / whole.pixel_count;
  piece.bend_offset_sigma_m = 0.004, piece.bend_angle_sigma_rad = 0.02;
  whole.area_m2 -= piece.area_m2;
  whole.pixel_count -= piece.pixel_count;
  frame.planes.push_back(piece);
}

TEST(PlaneAssociation, AFragmentDoesNotPutTheSurfaceInDoubtThatHoldsMostOfTheLandmark) {
  // What a bent sensor tears off a desk is small, so that it may be anything; the desk is not.
  Association a = TwoViews(DeskWithBook(0.03, ""), {}, {});
  const int desk = a.first.frame.plane_matches[0].map_plane;
  ASSERT_EQ(a.second.truth[0], 0);
  TearOff(a.second.frame, {15, 50, 24, 24});
  ASSERT_GT(a.second.frame.planes.back().pixel_count, 200);
  const auto matches = AssociatePlanes(a.second.frame, a.map, SmallCamera(), {}).matches;
  EXPECT_EQ(matches[0].decision, PlaneDecision::kMatched);
  EXPECT_EQ(matches[0].map_plane, desk);
  EXPECT_EQ(matches.back().decision, PlaneDecision::kUnmatched);
  EXPECT_EQ(matches.back().reason, MatchReason::kAmbiguous);
}

TEST(PlaneAssociation, APieceBeyondAStepIsTheLandmarkOnlyWhereItHasBeenSeenAsIt) {
  Association a = TwoViews(DeskWithBook(0.03, ""), {}, {});
  const int desk = a.first.frame.plane_matches[0].map_plane;
  ASSERT_EQ(a.second.truth[0], 0);
  TearOff(a.second.frame, {100, 0, 60, 120});
  const auto seen = AssociatePlanes(a.second.frame, a.map, SmallCamera(), {});
  ASSERT_EQ(seen.steps.size(), 1u);
  // The piece is nearer by 4 mm: the desk is lower than it.
  EXPECT_EQ(seen.steps[0].one, 0);
  EXPECT_NEAR(seen.steps[0].step_m, -0.004, 1e-4);
  EXPECT_GT(seen.steps[0].sigma_m, 0.0);
  EXPECT_EQ(seen.matches[0].map_plane, desk);
  EXPECT_EQ(seen.matches.back().map_plane, desk);

  // The same desk, had half of its right part not been seen before: the step may be a book's.
  std::erase_if(a.map.planes.At(desk).points_w, [](const auto& p_w) { return p_w.x() > 0.4; });
  const auto unseen = AssociatePlanes(a.second.frame, a.map, SmallCamera(), {});
  EXPECT_NE(unseen.matches.back().decision, PlaneDecision::kMatched);
}

TEST(PlaneAssociation, ASmallPieceBeyondAStepIsNotTheLandmarkAlthoughItWasOnceTakenForIt) {
  // What the desk's points cover may be a book that was taken for the desk by mistake.
  Association a = TwoViews(DeskWithBook(0.03, ""), {}, {});
  ASSERT_EQ(a.second.truth[0], 0);
  TearOff(a.second.frame, {100, 0, 60, 120});
  TearOff(a.second.frame, {0, 50, 40, 40});
  const int small = a.second.frame.planes.back().pixel_count;
  ASSERT_GT(8 * small,
            a.second.frame.planes[0].pixel_count);  // but a good part of what is left
  const auto matches = AssociatePlanes(a.second.frame, a.map, SmallCamera(), {}).matches;
  EXPECT_NE(matches.back().decision, PlaneDecision::kMatched);
}

TEST(PlaneAssociation, LeavesATieUndecided) {
  // Two landmarks six millimetres apart, the measured plane half way, nothing else to tell.
  PlaneWorld world;
  world.Add({0, 0, 0.003}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  const Camera camera = SmallCamera();
  Map map;
  for (const double height : {0.0, 0.006}) {
    PlaneWorld one;
    one.Add({0, 0, height}, {0.2, 0, 0}, {0, 0.2, 0}, "");
    SeenWorld seen = See(one, kFirst, camera, {}, Random{1});
    Map single;
    UpdatePlanes(seen.frame, single, camera, {}, SmallImages());
    ASSERT_EQ(single.planes.size(), 1u);
    AddLandmark(map, *single.planes.begin());
  }
  SeenWorld between = See(world, kFirst, camera, {}, Random{2});
  between.frame.plane_matches = AssociatePlanes(between.frame, map, camera, {}).matches;
  ASSERT_EQ(between.frame.plane_matches.size(), 1u);
  EXPECT_EQ(between.frame.plane_matches[0].decision, PlaneDecision::kUnmatched);
  EXPECT_EQ(between.frame.plane_matches[0].reason, MatchReason::kAmbiguous);
}

TEST(PlaneAssociation, NeverMatchesAPlaneOnAnUnstructuredObject) {
  const Camera camera = SmallCamera();
  const PlaneWorld world = DeskWithBook(0.02, "book");
  Map map;
  SeenWorld first = See(world, kFirst, camera, {}, Random{1});
  UpdatePlanes(first.frame, map, camera, {}, SmallImages());
  SeenWorld second = See(world, kFirst, camera, {}, Random{2});
  for (FramePlane& plane : second.frame.planes) plane.bad = BadReason::kUnstructured;
  second.frame.plane_matches = AssociatePlanes(second.frame, map, camera, {}).matches;
  ASSERT_FALSE(second.frame.plane_matches.empty());
  for (const PlaneMatch& match : second.frame.plane_matches) {
    EXPECT_EQ(match.decision, PlaneDecision::kUnmatched);
  }
}

}  // namespace
}  // namespace slam
