#include "slam/mapping/plane_split.h"

#include <gtest/gtest.h>

#include "slam/mapping/plane_fuse.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
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
  for (const Eigen::Vector3d& p_w : larger.points_w) EXPECT_LT(p_w.x(), voxel_m);
  for (const Eigen::Vector3d& p_w : lesser.points_w) EXPECT_GT(p_w.x(), -voxel_m);
  for (const MapPlane* m : landmarks) {
    EXPECT_GE(m->hull_w.size(), 3u);
    for (const Eigen::Vector3d& p_w : m->hull_w)
      EXPECT_NEAR(SignedDistance(m->pi_w, p_w), 0.0, 1e-9);
  }
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
