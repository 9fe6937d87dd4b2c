#include "eval/planes/plane_events.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <vector>

namespace eval {
namespace {

const RunEvent* FirstOfKind(const std::vector<RunEvent>& events, EventKind kind) {
  const auto found = std::find_if(events.begin(), events.end(),
                                  [&](const RunEvent& event) { return event.kind == kind; });
  return found == events.end() ? nullptr : &*found;
}

// Plane 2 was split off plane 1, which then went into plane 3: what the reader of the events finds
// in the map is plane 3.
TEST(FindPlaneEvents, FollowsThePlaneThatAnotherWasSplitOffThroughItsMerges) {
  std::vector<RunMapPlane> map(3);
  map[0].id = 1, map[0].merged_into = 3;
  map[1].id = 2, map[1].split_from = 1;
  map[2].id = 3;
  constexpr int kTop = 7, kSheet = 9;
  DecisionHistory history;
  for (const auto& [frame, truth, plane] :
       {std::tuple(0, kTop, 1), {1, kTop, 1}, {2, kSheet, 2}, {3, kTop, 1}}) {
    PlaneDecision decision;
    decision.record = {frame, truth, plane, 100};
    decision.centroid_g.setZero();
    history.decisions.push_back(decision);
  }
  const SceneTruth scene;
  const std::optional<Alignment> gauge;
  const auto events = FindPlaneEvents(history, {}, {}, {map, scene, gauge});
  const RunEvent* split = FirstOfKind(events, EventKind::kSplitOff);
  ASSERT_NE(split, nullptr);
  EXPECT_EQ(split->truth, kSheet);
  EXPECT_EQ(split->map_plane, 2);
  EXPECT_EQ(split->right_map_plane, 3);
  EXPECT_EQ(split->other_truth, kTop);
}

// A camera 2 m over a table looks down on it, and takes a hand 0.5 m over the table for the table.
// The run's own world begins 1 m higher than the truth's.
TEST(FindPlaneEvents, MeasuresNoiseFromWhereItIsInTheWorld) {
  constexpr int kTop = 7, kNothing = 0;
  FrameEvidence e;
  e.truth.T_gc.R = Eigen::Vector3d(1, -1, -1).asDiagonal();
  e.truth.T_gc.t = {0.4, 0.1, 2.0};
  e.truth.image_px = 1000.0;
  RunFramePlane plane;
  plane.map_plane = 1;
  plane.decision = "matched";
  DecisionHistory history;
  plane.centroid_c = {0, 0, 2.0};
  e.planes = {plane};
  e.truth_of = {{0, kTop}};
  history.Add(e);
  plane.centroid_c = {0.3, 0.2, 1.5};
  plane.pixels = 200;
  e.number = 1;
  e.planes = {plane};
  e.truth_of = {{0, kNothing}};
  history.Add(e);

  std::vector<RunMapPlane> map(1);
  map[0].id = 1;
  map[0].pi_w = {Eigen::Vector3d::UnitZ(), 1.0};
  std::optional<Alignment> gauge = Alignment{};
  gauge->T_gw.t.z() = 1.0;
  const SceneTruth scene;
  const auto events = FindPlaneEvents(history, {}, {}, {map, scene, gauge});
  const RunEvent* wrong = FirstOfKind(events, EventKind::kWrong);
  ASSERT_NE(wrong, nullptr);
  EXPECT_EQ(wrong->frame, 1);
  EXPECT_NEAR(wrong->distance_mm.value(), 500.0, 1e-9);
  EXPECT_NEAR(wrong->harm_px_mm.value(), 200 * 500.0, 1e-6);
}

}  // namespace
}  // namespace eval
