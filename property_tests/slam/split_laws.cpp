#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/planes.h"
#include "slam/mapping/plane_fuse.h"
#include "tests/support/two_patches.h"

namespace slam {
namespace {

constexpr int kFrames = 8;

/// Two patches with a step between them that no floor of a comparison explains.
TwoPatches AnyTwoPatches() {
  TwoPatches show;
  show.larger_m = AnyReal(0.3, 0.5);
  show.lesser_m = AnyReal(0.15, 0.25);
  show.height_m = AnyReal(0.008, 0.03) * (AnyInt(0, 1) ? 1 : -1);
  return show;
}

void ShowAll(TwoPatches& show) {
  for (int k = 0; k < kFrames; ++k) show.Next();
}

RC_GTEST_PROP(PlaneSplit, PutsEachSideWhereItIs, ()) {
  TwoPatches show = AnyTwoPatches();
  ShowAll(show);
  const auto landmarks = Landmarks(show.map);
  RC_ASSERT(landmarks.size() == 2u);
  RC_ASSERT(landmarks[1]->split_from == landmarks[0]->id);
  RC_ASSERT(landmarks[0]->area_m2 > landmarks[1]->area_m2);
  const Eigen::Vector3d in_larger_w(-show.larger_m / 2, 0, 0);
  const Eigen::Vector3d in_lesser_w(show.lesser_m / 2, 0, show.height_m);
  RC_ASSERT(std::abs(SignedDistance(landmarks[0]->pi_w, in_larger_w)) < 1e-4);
  RC_ASSERT(std::abs(SignedDistance(landmarks[1]->pi_w, in_lesser_w)) < 1e-4);
}

RC_GTEST_PROP(PlaneSplit, IsDoneOnceAndStays, ()) {
  TwoPatches show = AnyTwoPatches();
  ShowAll(show);
  for (int more = 0; more < 3; ++more) {
    RC_ASSERT(FusePlanes(show.map, {}, SmallImages()) == 0);
    show.Next();
    RC_ASSERT(Landmarks(show.map).size() == 2u);
  }
}

RC_GTEST_PROP(PlaneSplit, DoesNotDependOnTheOrderOfPlanes, ()) {
  TwoPatches show = AnyTwoPatches(), reversed = show;
  reversed.reverse = true;
  ShowAll(show), ShowAll(reversed);
  const auto a = Landmarks(show.map), b = Landmarks(reversed.map);
  RC_ASSERT(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    RC_ASSERT(a[i]->id == b[i]->id);
    RC_ASSERT(a[i]->split_from == b[i]->split_from);
    RC_ASSERT(a[i]->split_at_s == b[i]->split_at_s);
    RC_ASSERT((a[i]->pi_w.n - b[i]->pi_w.n).norm() < 1e-9);
    RC_ASSERT(std::abs(a[i]->pi_w.d - b[i]->pi_w.d) < 1e-9);
  }
}

RC_GTEST_PROP(PlaneSplit, LeavesPiecesThatAreOneSurface, ()) {
  // Whatever step the frames tell of: the pieces lie in one plane.
  TwoPatches show = AnyTwoPatches();
  show.told_step_m = show.height_m;
  show.height_m = 0.0;
  ShowAll(show);
  RC_ASSERT(Landmarks(show.map).size() == 1u);
}

RC_GTEST_PROP(PlaneSplit, LeavesAStepThatTheSensorMayBend, ()) {
  // Never as much as two bends, from a place that does not change.
  TwoPatches show = AnyTwoPatches();
  show.bend_ratio = AnyReal(0.002, 0.005);
  show.height_m = AnyReal(-1.0, 1.0) * show.bend_ratio;
  for (int k = 0; k < 5 * kFrames; ++k) show.Next();
  RC_ASSERT(Landmarks(show.map).size() == 1u);
}

}  // namespace
}  // namespace slam
