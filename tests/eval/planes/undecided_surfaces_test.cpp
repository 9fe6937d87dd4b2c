#include <gtest/gtest.h>

#include "eval/planes/plane_decisions.h"

namespace eval {
namespace {

/// A desk, truth 7, that is seen in frames 0, 50, 51 and 52, two seconds later, and put on map
/// plane 3 in frame `first_decided`.
DecisionHistory DeskDecidedIn(int first_decided) {
  DecisionHistory history;
  history.first_s = 0.0;
  for (const int frame : {0, 50, 51, 52}) {
    SeenSurface desk;
    desk.frame = frame;
    desk.stamp_s = frame / 25.0;
    desk.truth = 7;
    desk.is_large = true;
    desk.decided = frame == first_decided;
    history.surfaces.push_back(desk);
  }
  PlaneDecision decision;
  decision.record = {first_decided, 7, 3};
  history.decisions = {decision};
  return history;
}

TEST(UndecidedSurfaces, AreThoseWithALandmarkOfAnEarlierFrame) {
  // Frame 0 is within the first second.
  for (const auto& [first, large] : {std::pair(0, 3), {50, 2}, {51, 1}, {52, 0}}) {
    const UndecidedSurfaces found = FindUndecided(DeskDecidedIn(first));
    EXPECT_EQ(found.large, large) << first;
    EXPECT_EQ(found.undecided.size(), static_cast<std::size_t>(large)) << first;
  }
}

}  // namespace
}  // namespace eval
