#include "slam/mapping/plane_split.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "slam/mapping/plane_fuse.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"
#include "tests/support/small_images.h"
#include "tests/support/two_patches.h"

namespace slam {
namespace {

TEST(PlaneSplit, MakesTwoLandmarksOfTwoSurfacesThatThreeFramesShowedBesideAStep) {
  TwoPatches show;
  show.height_m = 0.008;
  for (int k = 0; k < 4; ++k) show.Next();
  const auto landmarks = Landmarks(show.map);
  ASSERT_EQ(landmarks.size(), 2u);
  const MapPlane &larger = *landmarks[0], &lesser = *landmarks[1];
  EXPECT_EQ(larger.split_from, kNone);
  EXPECT_EQ(lesser.split_from, larger.id);
  EXPECT_EQ(lesser.split_at_s, show.frame.timestamp_s);
  EXPECT_GT(larger.area_m2, lesser.area_m2);
  // Each is where it is, and holds its own points alone.
  EXPECT_NEAR(SignedDistance(larger.pi_w, {-0.2, 0, 0}), 0.0, 1e-4);
  EXPECT_NEAR(SignedDistance(lesser.pi_w, {0.1, 0, 0.008}), 0.0, 1e-4);
  const double voxel_m = SmallImages().voxel_m;  // as near as clouds tell
  ASSERT_FALSE(larger.points_w.empty() || lesser.points_w.empty());
  for (const Eigen::Vector3d& p_w : larger.points_w) EXPECT_LT(p_w.x(), voxel_m);
  for (const Eigen::Vector3d& p_w : lesser.points_w) EXPECT_GT(p_w.x(), -voxel_m);
  for (const MapPlane* m : landmarks) {
    EXPECT_GE(m->hull_w.size(), 3u);
    for (const Eigen::Vector3d& p_w : m->hull_w)
      EXPECT_NEAR(SignedDistance(m->pi_w, p_w), 0.0, 1e-9);
  }
}

TEST(PlaneSplit, LeavesEachSideItsOwnShapeAndParameters) {
  TwoPatches show;
  for (int k = 0; k < 4; ++k) show.Next();
  const auto landmarks = Landmarks(show.map);
  ASSERT_EQ(landmarks.size(), 2u);
  const MapPlane &larger = *landmarks[0], &lesser = *landmarks[1];
  // The patches measure 0.4 m and 0.2 m by 0.6 m; pixels are 7 mm.
  EXPECT_NEAR(larger.area_m2, 0.24, 0.02);
  EXPECT_NEAR(lesser.area_m2, 0.12, 0.02);
  EXPECT_THAT(larger.centroid_w, VectorNear(Eigen::Vector3d(-0.2, 0, 0), 0.02));
  EXPECT_THAT(lesser.centroid_w, VectorNear(Eigen::Vector3d(0.1, 0, 0.008), 0.02));
  for (const MapPlane* m : landmarks) {
    EXPECT_THAT(m->estimate.Mean(), PlaneNear(m->pi_w, 1e-9, 1e-9));
    EXPECT_TRUE(m->parts.empty());
  }
}

TEST(PlaneSplit, LaysKnownCornersOntoThePlaneOfTheSideThatKeepsThem) {
  TwoPatches show;
  show.height_m = 0.02;
  for (int k = 0; k < 3; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 1u);
  MapPlane& whole = *Landmarks(show.map)[0];
  // On the plane that both patches made together, which cuts the step.
  const std::vector<Eigen::Vector3d> corners_w{
      {-0.4, -0.3, 0}, {0, -0.3, 0}, {0, 0.3, 0}, {-0.4, 0.3, 0}};
  whole.vertices_w.clear();
  double off_m = 0.0;
  for (const Eigen::Vector3d& corner_w : corners_w) {
    whole.vertices_w.push_back(ProjectOnto(whole.pi_w, corner_w));
    off_m = std::max(off_m, (whole.vertices_w.back() - corner_w).norm());
  }
  ASSERT_GT(off_m, 0.002);
  whole.vertex_weights.assign(4, 5.0);
  show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  const MapPlane& larger = *Landmarks(show.map)[0];
  ASSERT_EQ(larger.vertices_w.size(), 4u);
  for (const Eigen::Vector3d& corner_w : larger.vertices_w) {
    EXPECT_NEAR(SignedDistance(larger.pi_w, corner_w), 0.0, 1e-9);
    EXPECT_NEAR(corner_w.z(), 0.0, 1e-3);
  }
}

TEST(PlaneSplit, LeavesEachCornerToTheSideOnWhichItLies) {
  TwoPatches show;
  for (int k = 0; k < 3; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 1u);
  MapPlane& whole = *Landmarks(show.map)[0];
  whole.vertices_w = {{-0.4, -0.3, 0}, {0.2, -0.3, 0}, {0.2, 0.3, 0}, {-0.4, 0.3, 0}};
  whole.vertex_weights = {5.0, 6.0, 7.0, 8.0};
  show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  const MapPlane& larger = *Landmarks(show.map)[0];
  ASSERT_EQ(larger.vertices_w.size(),
            2u);  // those of the other side are corners of a part of it
  EXPECT_THAT(larger.vertices_w[0], VectorNear(Eigen::Vector3d(-0.4, -0.3, 0), 1e-3));
  EXPECT_THAT(larger.vertices_w[1], VectorNear(Eigen::Vector3d(-0.4, 0.3, 0), 1e-3));
  EXPECT_EQ(larger.vertex_weights, (std::vector<double>{5.0, 8.0}));
}

TEST(PlaneSplit, SharesTheMapPointsOutByWhereTheyLie) {
  TwoPatches show;
  for (int k = 0; k < 3; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 1u);
  for (const Eigen::Vector3d& p_w :
       {Eigen::Vector3d(-0.2, 0, 0), Eigen::Vector3d(0.1, 0, 0.008)}) {
    MapPoint point;
    point.id = static_cast<int>(show.map.points.size());
    point.p_w = p_w;
    show.map.points.push_back(point);
    Landmarks(show.map)[0]->map_points.insert(point.id);
  }
  show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  EXPECT_EQ(Landmarks(show.map)[0]->map_points, std::set<int>{0});
  EXPECT_EQ(Landmarks(show.map)[1]->map_points, std::set<int>{1});
}

TEST(PlaneSplit, CountsTheFramesThatShowedBothAndTheStep) {
  TwoPatches show;
  show.height_m = 0.005;
  for (int k = 0; k < 5; ++k) {
    show.shows_step = k != 2;
    show.Next();
  }
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  const MapPlane &larger = *Landmarks(show.map)[0], &lesser = *Landmarks(show.map)[1];
  const auto counts = [](const MapPlane& other, int frames) {
    return std::map<int, int>{{other.id, frames}};
  };
  EXPECT_EQ(larger.covisible, counts(lesser, 4));  // all but the first, which made the landmark
  EXPECT_EQ(lesser.covisible, counts(larger, 4));
  EXPECT_EQ(larger.stepped, counts(lesser, 3));
  EXPECT_EQ(lesser.stepped, counts(larger, 3));
  EXPECT_EQ(larger.observations, 5);
  EXPECT_EQ(lesser.observations, 3);
}

TEST(PlaneSplit, LeavesTheIdAndTheHistoryWithTheLargerSideThoughItFillsFewerPixels) {
  TwoPatches show;
  show.height_m = 0.1;  // nearer to the camera
  show.lesser_m = 0.36;
  for (int k = 0; k < 3; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 1u);
  MapPlane& whole = *Landmarks(show.map)[0];
  whole.split_from = 7, whole.split_at_s = -1.5;
  whole.covisible = {{9, 5}}, whole.stepped = {{9, 2}};
  const MapPlane before = whole;
  show.Next();
  const auto landmarks = Landmarks(show.map);
  ASSERT_EQ(landmarks.size(), 2u);
  const std::size_t one = show.IndexOf(TwoPatches::kLarger);
  const std::size_t other = show.IndexOf(TwoPatches::kLesser);
  const int one_px = show.frame.planes[one].pixel_count;
  const int other_px = show.frame.planes[other].pixel_count;
  ASSERT_LT(one_px, other_px);

  const MapPlane &larger = *landmarks[0], &lesser = *landmarks[1];
  EXPECT_EQ(larger.id, before.id);
  EXPECT_NEAR(larger.centroid_w.x(), -0.2, 0.02);
  EXPECT_GT(larger.area_m2, lesser.area_m2);
  EXPECT_EQ(larger.split_from, 7);
  EXPECT_EQ(larger.split_at_s, -1.5);
  EXPECT_EQ(larger.covisible, (std::map<int, int>{{9, 5}, {lesser.id, 3}}));
  EXPECT_EQ(larger.stepped, (std::map<int, int>{{9, 2}, {lesser.id, 3}}));
  EXPECT_EQ(larger.observations, 4);
  EXPECT_EQ(larger.seen_px, before.seen_px + one_px + other_px);
  EXPECT_EQ(larger.first_frame, 0);
  EXPECT_EQ(larger.first_seen_s, 0.0);
  EXPECT_EQ(larger.last_frame, 3);
  EXPECT_EQ(larger.last_seen_s, show.frame.timestamp_s);

  EXPECT_EQ(lesser.split_from, larger.id);
  EXPECT_EQ(lesser.observations, 3);  // beside a step
  EXPECT_NEAR(lesser.seen_px, 3 * other_px, 0.05 * other_px);
  EXPECT_EQ(lesser.covisible, (std::map<int, int>{{larger.id, 3}}));
  EXPECT_EQ(show.frame.plane_matches[one].decision, PlaneDecision::kMatched);
  EXPECT_EQ(show.frame.plane_matches[other].decision, PlaneDecision::kNew);
  EXPECT_EQ(show.frame.plane_matches[other].map_plane, lesser.id);
}

TEST(PlaneSplit, ForgetsThePartThatWasSeenLeastForANewOneWhereThereAreFour) {
  TwoPatches show;
  show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 1u);
  MapPlane& whole = *Landmarks(show.map)[0];
  for (const int apart : {5, 1, 3, 4}) {
    PlanePart& part = whole.parts.emplace_back();
    part.surface.pi_w = whole.pi_w;
    part.surface.points_w = {{10.0 * apart, 0, 0}};
    part.apart = part.seen = apart;
  }
  show.Next();
  std::vector<int> apart;
  for (const PlanePart& part : Landmarks(show.map)[0]->parts) apart.push_back(part.apart);
  EXPECT_EQ(apart, (std::vector<int>{5, 3, 4, 1}));
}

TEST(PlaneSplit, LearnsAPartBesideTheLargestOfItsNeighbours) {
  // A narrow strip between two sheets of one height, of which the right one is wider.
  PlaneWorld world;
  world.Add({-0.15, 0, 0}, {0.1, 0, 0}, {0, 0.3, 0}, "");
  world.Add({0, 0, 0.008}, {0.05, 0, 0}, {0, 0.3, 0}, "");
  world.Add({0.25, 0, 0}, {0.2, 0, 0}, {0, 0.3, 0}, "");
  Map map;
  for (int k = 0; k < 2; ++k) {
    SeenWorld seen =
        See(world, LookAt({0, -0.7, 0.7}, {0, 0, 0}), SmallCamera(), {}, Random{1});
    Frame& frame = seen.frame;
    ASSERT_EQ(frame.planes.size(), 3u);
    const auto at = [&](int surface) {
      return static_cast<int>(std::find(seen.truth.begin(), seen.truth.end(), surface) -
                              seen.truth.begin());
    };
    frame.index = k;
    for (int f = 0; f < 3; ++f) {
      PlaneMatch& match = frame.plane_matches.emplace_back();
      if (k > 0) match = {PlaneDecision::kMatched, 0, MatchReason::kParameters};
      if (k == 0 && f != at(2)) match.reason = MatchReason::kAmbiguous;
    }
    if (k > 0) {
      frame.plane_steps = {{at(1), at(0), 0.008, 0.0005}, {at(1), at(2), 0.008, 0.0005}};
    }
    UpdatePlanes(frame, map, SmallCamera(), {}, SmallImages());
  }
  ASSERT_EQ(Landmarks(map).size(), 1u);
  const auto& parts = Landmarks(map)[0]->parts;
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(parts[0].surface.centroid_w.x(), 0.0, 0.02);
  EXPECT_NEAR(parts[0].rest.centroid_w.x(), 0.25, 0.02);
}

TEST(PlaneSplit, IsMadeWhicheverSideTheStepIsToldFrom) {
  for (const double height_m : {0.008, -0.008}) {
    TwoPatches show;
    show.height_m = height_m;
    show.told_of_larger = true;
    for (int k = 0; k < 4; ++k) show.Next();
    EXPECT_EQ(Landmarks(show.map).size(), 2u) << height_m;
  }
}

TEST(PlaneSplit, IsTheDecisionOnThePlaneThatShowsTheNewLandmark) {
  TwoPatches show;
  for (int k = 0; k < 4; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  const PlaneMatch& lesser = show.frame.plane_matches[show.IndexOf(TwoPatches::kLesser)];
  EXPECT_EQ(lesser.decision, PlaneDecision::kNew);
  EXPECT_EQ(lesser.reason, MatchReason::kSplit);
  EXPECT_EQ(lesser.map_plane, Landmarks(show.map)[1]->id);
  const PlaneMatch& larger = show.frame.plane_matches[show.IndexOf(TwoPatches::kLarger)];
  EXPECT_EQ(larger.decision, PlaneDecision::kMatched);
  EXPECT_EQ(larger.map_plane, Landmarks(show.map)[0]->id);
}

TEST(PlaneSplit, NeedsAStep) {
  TwoPatches show;
  show.shows_step = false;
  for (int k = 0; k < 12; ++k) show.Next();
  EXPECT_EQ(Landmarks(show.map).size(), 1u);
}

TEST(PlaneSplit, NeedsAStepInMostOfTheFrames) {
  for (const int every : {1, 3, 5}) {
    SCOPED_TRACE(every);
    TwoPatches show;
    show.height_m = 0.005;
    for (int k = 0; k < 25; ++k) {
      show.shows_step = k % every == 0;
      show.Next();
    }
    EXPECT_EQ(Landmarks(show.map).size(), every == 1 ? 2u : 1u);
  }
}

TEST(PlaneSplit, NeedsSidesThatDoNotFitEachOther) {
  // An edge in the depth of one flat surface.
  TwoPatches show;
  show.height_m = 0.0;
  show.told_step_m = 0.008;
  for (int k = 0; k < 12; ++k) show.Next();
  EXPECT_EQ(Landmarks(show.map).size(), 1u);
}

TEST(PlaneSplit, LeavesWhatTheSensorBends) {
  // One surface: the bends lift its pieces by turns, by twice what they do as a rule.
  TwoPatches show;
  show.bend_ratio = 0.0033;
  for (int k = 0; k < 40; ++k) {
    show.height_m = k / 10 % 2 == 0 ? 0.006 : -0.006;
    show.Next();
  }
  EXPECT_EQ(Landmarks(show.map).size(), 1u);
}

TEST(PlaneSplit, IsNoSurerOfASmallStepForHavingSeenItForLong) {
  // As much of the past as counts does not make one step of a bend's size certain.
  TwoPatches show;
  show.bend_ratio = 0.0033;
  show.told_step_m = 0.0012;  // where the sides stand apart by more
  for (int k = 0; k < 150; ++k) show.Next();
  EXPECT_EQ(Landmarks(show.map).size(), 1u);
}

TEST(PlaneSplit, SeesAStepBeyondWhatTheSensorBends) {
  TwoPatches show;
  show.bend_ratio = 0.0033;
  show.height_m = 0.03;
  for (int k = 0; k < 10; ++k) show.Next();
  EXPECT_EQ(Landmarks(show.map).size(), 2u);
}

TEST(PlaneSplit, IsNotUndoneByFusion) {
  TwoPatches show;
  for (int k = 0; k < 12; ++k) show.Next();
  ASSERT_EQ(Landmarks(show.map).size(), 2u);
  // Later estimates may agree, and frames show no step.
  MapPlane &one = *Landmarks(show.map)[0], &other = *Landmarks(show.map)[1];
  other.pi_w = one.pi_w;
  other.estimate = one.estimate;
  other.points_w = one.points_w;
  one.stepped.clear(), other.stepped.clear();
  EXPECT_EQ(FusePlanes(show.map, {}, SmallImages()), 0);
  // Without the split they would be one.
  other.split_from = kNone;
  EXPECT_EQ(FusePlanes(show.map, {}, SmallImages()), 1);
}

TEST(PlaneSplit, MayFollowAFusionThatWasWrong) {
  // Two landmarks, fused; then frames show both as the one that is left.
  TwoPatches show;
  show.height_m = 0.0;
  show.shows_step = false;
  show.Next();
  MapPlane twin = *Landmarks(show.map)[0];
  const int id = twin.id;
  for (int k = 0; k < 6; ++k) show.Next();
  twin.observations = 10;
  AddLandmark(show.map, twin);
  ASSERT_EQ(FusePlanes(show.map, {}, SmallImages()), 1);
  show.height_m = 0.012;
  show.shows_step = true;
  for (int k = 0; k < 20; ++k) show.Next();
  const auto landmarks = Landmarks(show.map);
  ASSERT_EQ(landmarks.size(), 2u);
  EXPECT_EQ(landmarks[1]->split_from, id);
  EXPECT_EQ(FusePlanes(show.map, {}, SmallImages()), 0);
}

TEST(PlaneSplit, IsNotUndoneByFusionByWayOfAnOlderLandmark) {
  // Both sides of a split agree with one that is older, one of them first; only one can be it.
  Map map;
  int seen_later = 0;
  TwoPatches show;
  show.shows_step = false;
  for (int k = 0; k < 12; ++k) show.Next();
  for (int id = 0; id < 3; ++id) AddLandmark(map, *Landmarks(show.map)[0]);
  map.planes.At(2).split_from = 1;
  std::swap(map.planes.At(1).observations, seen_later);
  ASSERT_EQ(FusePlanes(map, {}, SmallImages()), 1);
  ASSERT_EQ(map.planes.At(2).merged_into, 0);
  std::swap(map.planes.At(1).observations, seen_later);
  EXPECT_EQ(FusePlanes(map, {}, SmallImages()), 0);
}

}  // namespace
}  // namespace slam
