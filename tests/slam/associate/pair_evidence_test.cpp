#include "slam/associate/pair_evidence.h"

#include <gtest/gtest.h>

#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

/// A top alone, and a map that knows it.
struct KnownTop {
  const Camera camera = SmallCamera();
  const AssociationConfig config;
  SeenWorld seen;
  Map map;

  explicit KnownTop(const std::string& class_name) {
    PlaneWorld world;
    world.Add({0, 0, 0}, {0.8, 0, 0}, {0, 0.5, 0}, class_name);
    seen = See(world, LookAt({0, -0.8, 0.7}, {0, 0, 0}), camera, {}, Random{1});
    PlaneMapConfig one_view;
    one_view.trial_pixels = 480, one_view.trial_frames = 1;
    UpdatePlanes(seen.frame, map, camera, {}, one_view);
  }
  MapPlane& landmark() { return *Landmarks(map).at(0); }
  PairTable Weigh() const {
    const UncertainPose pose = {seen.frame.T_cw, 1e-7 * Matrix6d::Identity()};
    PairRefusals refused;
    return WeighPairs(seen.frame, map, pose, pose, camera, config, refused);
  }
};

TEST(PairEvidence, CountsTheKeyframesSinceTheLandmarkWasSeen) {
  KnownTop top("");
  EXPECT_EQ(top.Weigh().at(0).at(0).links, 0);
  for (int k = 1; k <= 3; ++k) {
    top.map.keyframes.emplace_back();
    top.map.keyframes.back().id = k - 1;
    top.map.keyframes.back().frame_index = top.landmark().last_frame + k;
  }
  const PairTable pairs = top.Weigh();
  EXPECT_EQ(pairs.at(0).at(0).links, 3);
  EXPECT_TRUE(PairsBeyondDoubt(top.seen.frame, pairs).empty());  // by now the pose has drifted
}

TEST(PairEvidence, ABoxCostsWhatItDoesNotShareWithThatOfTheLandmark) {
  KnownTop top("book");
  ASSERT_TRUE(top.seen.frame.planes.at(0).detection);
  Box& box_px = top.seen.frame.detections.at(0).box_px;
  EXPECT_LT(top.Weigh().at(0).at(0).box_cost, 0.2 * top.config.iou_weight);
  box_px.max.x() = 0.5 * (box_px.min.x() + box_px.max.x());  // half of it: so is what is shared
  EXPECT_NEAR(top.Weigh().at(0).at(0).box_cost, 0.5 * top.config.iou_weight,
              0.1 * top.config.iou_weight);
  // A box that is not there says nothing, nor does one of what either side has no class of.
  top.seen.frame.planes[0].detection = 7;
  EXPECT_EQ(top.Weigh().at(0).at(0).box_cost, 0);
  top.seen.frame.planes[0].detection = 0;
  const std::string known = top.landmark().class_name;
  top.landmark().class_name.clear();
  EXPECT_EQ(top.Weigh().at(0).at(0).box_cost, 0);
  top.landmark().class_name = known;
  top.seen.frame.planes[0].class_name.clear();
  EXPECT_EQ(top.Weigh().at(0).at(0).box_cost, 0);
}

TEST(PairEvidence, WeighsPlaceAndParametersTogether) {
  // At the place of its landmark, and farther off than one surface is as a rule.
  KnownTop desk("");
  MapPlane& landmark = desk.landmark();
  const AssociationConfig& config = desk.config;
  const double known_d = landmark.pi_w.d;
  int between = 0, beyond = 0;
  for (double off_m = 0.0; off_m < 0.03; off_m += 0.0005) {
    landmark.pi_w.d = known_d - off_m;
    const PairTable pairs = desk.Weigh();
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

TEST(PairsBeyondDoubt, AreOfASoundPlaneAndOfTheOnlyLandmarkThatItCanShow) {
  using Pairs = std::vector<std::pair<int, int>>;
  const Pairs none, certain{{0, 7}};
  PairEvidence pair, rival;
  pair.map_plane = 7, rival.map_plane = 8;
  pair.verdict = rival.verdict = PairVerdict::kPossible;
  pair.overlap = rival.overlap = 0.51;
  Frame frame;
  frame.planes.resize(1);
  const auto beyond_doubt = [&](const std::vector<PairEvidence>& row) {
    return PairsBeyondDoubt(frame, {row});
  };
  EXPECT_EQ(beyond_doubt({pair}), certain);
  EXPECT_EQ(beyond_doubt({}), none);

  // Another landmark in question is a rival, a candidate or one that was refused is none.
  for (const PairVerdict verdict : {PairVerdict::kPossible, PairVerdict::kDoubtful}) {
    rival.verdict = verdict;
    rival.on_trial = false;
    EXPECT_EQ(beyond_doubt({pair, rival}), none);
    EXPECT_EQ(beyond_doubt({rival, pair}), none);
    rival.on_trial = true;
    EXPECT_EQ(beyond_doubt({pair, rival}), certain);
    EXPECT_EQ(beyond_doubt({rival, pair}), certain);
    EXPECT_EQ(beyond_doubt({rival}), none);
  }
  rival.on_trial = false, rival.verdict = PairVerdict::kRefused;
  EXPECT_EQ(beyond_doubt({rival, pair}), certain);

  PairEvidence half = pair, doubtful = pair;
  half.overlap = 0.5, doubtful.verdict = PairVerdict::kDoubtful;
  EXPECT_EQ(beyond_doubt({half}), none) << "less than most of it";
  EXPECT_EQ(beyond_doubt({doubtful}), none);
  frame.planes[0].bad = BadReason::kBorder;
  EXPECT_EQ(beyond_doubt({pair}), none);
}

}  // namespace
}  // namespace slam
