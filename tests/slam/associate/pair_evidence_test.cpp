#include "slam/associate/pair_evidence.h"

#include <gtest/gtest.h>

#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

TEST(PairEvidence, WeighsPlaceAndParametersTogether) {
  // A desk alone, at the place of its landmark, and farther off than one surface is as a rule.
  PlaneWorld desk;
  desk.Add({0, 0, 0}, {0.8, 0, 0}, {0, 0.5, 0}, "");
  const Camera camera = SmallCamera();
  SeenWorld seen = See(desk, LookAt({0, -0.8, 0.7}, {0, 0, 0}), camera, {}, Random{1});
  PlaneMapConfig one_view;
  one_view.trial_pixels = 480, one_view.trial_frames = 1;
  Map map;
  UpdatePlanes(seen.frame, map, camera, {}, one_view);
  MapPlane& landmark = *Landmarks(map).at(0);
  const UncertainPose pose = {seen.frame.T_cw, 1e-7 * Matrix6d::Identity()};
  const AssociationConfig config;
  const double known_d = landmark.pi_w.d;
  int between = 0, beyond = 0;
  for (double off_m = 0.0; off_m < 0.03; off_m += 0.0005) {
    landmark.pi_w.d = known_d - off_m;
    PairRefusals refused;
    const PairTable pairs = WeighPairs(seen.frame, map, pose, pose, camera, config, refused);
    if (pairs.at(0).empty()) break;  // certainly two
    const PairEvidence& pair = pairs[0][0];
    ASSERT_GT(pair.overlap, 0.9);
    between += pair.verdict == PairVerdict::kPossible && pair.parameter_cost > config.max_chi2;
    beyond += pair.verdict == PairVerdict::kDoubtful;
    const double cost =
        pair.parameter_cost + pair.overlap_cost + pair.class_cost + pair.box_cost;
    const bool dear = !(cost < config.max_chi2 + config.overlap_weight);
    EXPECT_EQ(pair.verdict, dear ? PairVerdict::kDoubtful : PairVerdict::kPossible);
  }
  EXPECT_GT(between, 0);
  EXPECT_GT(beyond, 0);
}

}  // namespace
}  // namespace slam
