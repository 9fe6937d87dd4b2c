// A camera that has drifted, or whose pose motion alone tells: planes are associated centimetres to tens of
// centimetres beside the truth.
#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "slam/associate/associate_planes.h"
#include "slam/associate/correct_prediction.h"
#include "slam/associate/pair_evidence.h"
#include "slam/mapping/plane_motion.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

PlaneMapConfig OneViewIsTheMap() {
  PlaneMapConfig config;
  config.trial_pixels = 480, config.trial_frames = 1;
  return config;
}

/// The map's keyframes of so many frames, one each.
void AddKeyframes(Map& map, int frames) {
  for (int i = 0; i < frames; ++i) {
    Keyframe keyframe;
    keyframe.id = keyframe.frame_index = i;
    map.keyframes.push_back(keyframe);
  }
}

constexpr int kKeyframes = 20;

struct Return {
  Map map;
  Frame frame;
};

/// A desk that was mapped 20 keyframes ago and last seen this many ago, and a view of it by a camera
/// that is off along its normal.
Return ReturnTo(int keyframes_since_seen, double off_m) {
  PlaneWorld world;
  world.Add({0, 0, 0}, {0.3, 0, 0}, {0, 0.2, 0}, "");
  const Camera camera = SmallCamera();
  Return out;
  SeenWorld first = See(world, LookAt({0, -0.8, 0.7}, {0, 0, 0}), camera, {}, Random{1});
  UpdatePlanes(first.frame, out.map, camera, {}, OneViewIsTheMap());
  AddKeyframes(out.map, kKeyframes + 1);
  Landmarks(out.map)[0]->last_frame = kKeyframes - keyframes_since_seen;
  out.frame =
      See(world, LookAt({0.15, -0.75, 0.65}, {0.02, 0, 0}), camera, {}, Random{2}).frame;
  out.frame.index = kKeyframes + 1;
  out.frame.T_cw.t += off_m * out.frame.planes[0].pi_c.n;
  return out;
}

TEST(DriftedPose, RecognisesASurfaceThatComesBackAfterThePoseHasDrifted) {
  const auto decision = [](int keyframes_since_seen) {
    const Return r = ReturnTo(keyframes_since_seen, 0.045);
    return AssociatePlanes(r.frame, r.map, SmallCamera(), {}).matches[0].decision;
  };
  EXPECT_EQ(decision(kKeyframes), PlaneDecision::kMatched);
  // The same error is none of the pose where the landmark was seen just now.
  EXPECT_EQ(decision(0), PlaneDecision::kUnmatched);
  EXPECT_EQ(decision(1), PlaneDecision::kUnmatched);
}

TEST(DriftedPose, CountsWhatRefusedAPairAndNoPairThatWasPossible) {
  const auto refused = [](double off_m) {
    const Return r = ReturnTo(0, off_m);
    return AssociatePlanes(r.frame, r.map, SmallCamera(), {}).refused.count;
  };
  PairRefusals expected;
  EXPECT_EQ(refused(0.0), expected.count);
  expected.Add(PairRefusal::kParameters);
  EXPECT_EQ(refused(0.1), expected.count);
}

TEST(DriftedPose, ChargesALandmarkForHowMuchMoreFitsItSinceItWasSeen) {
  const auto cost = [](int keyframes_since_seen) {
    const Return r = ReturnTo(keyframes_since_seen, 0.0);
    const UncertainPose pose = PredictedPose(r.frame);
    PairRefusals refused;
    const PairTable pairs = WeighPairs(r.frame, r.map, pose, pose, SmallCamera(), {}, refused);
    return pairs.at(0).at(0).Cost() - pairs.at(0).at(0).parameter_cost;
  };
  const double seen_now = cost(0), after_5 = cost(5) - seen_now, after_20 = cost(20) - seen_now;
  // Of 3 degrees of freedom each fits sqrt(1 + links) as much, at most.
  EXPECT_GT(after_5, 0.5 * 3 * std::log(6.0));
  EXPECT_LT(after_5, 3 * std::log(6.0));
  EXPECT_GT(after_20, after_5);
  EXPECT_LT(after_20, 3 * std::log(21.0));
}

TEST(DriftedPose, CorrectsThePoseByLandmarksAloneThatNoDriftLiesBetween) {
  Frame frame;
  frame.planes.resize(1);
  PairEvidence pair;
  pair.map_plane = 7;
  pair.verdict = PairVerdict::kPossible;
  pair.overlap = 0.9;
  using Pairs = std::vector<std::pair<int, int>>;
  EXPECT_EQ(PairsBeyondDoubt(frame, {{pair}}), Pairs({{0, 7}}));
  pair.links = 1;
  EXPECT_EQ(PairsBeyondDoubt(frame, {{pair}}), Pairs{});
}

// A board beside the desk, seen all the time, tells where the camera is to a millimetre now. The map
// between the desk and here has drifted all the same.
TEST(DriftedPose, IsOfTheMapHoweverWellALandmarkOfNowTellsThePose) {
  const Camera camera = SmallCamera();
  PlaneWorld world;
  world.Add({-0.3, 0, 0}, {0.25, 0, 0}, {0, 0.2, 0}, "");
  world.Add({0.3, 0, 0.1}, {0.2, 0, 0}, {0, 0.2, 0}, "");
  Map map;
  SeenWorld first = See(world, LookAt({0, -1.1, 1.0}, {0, 0, 0}), camera, {}, Random{1});
  UpdatePlanes(first.frame, map, camera, {}, OneViewIsTheMap());
  ASSERT_EQ(Landmarks(map).size(), 2u);
  AddKeyframes(map, kKeyframes + 1);
  MapPlane &desk = *Landmarks(map)[0], &board = *Landmarks(map)[1];
  desk.last_frame = 0;
  board.last_frame = kKeyframes;
  MovePlane(desk, {Eigen::Matrix3d::Identity(), {0, 0, 0.045}});
  Frame frame = See(world, LookAt({0.05, -1.1, 1.0}, {0, 0, 0}), camera, {}, Random{2}).frame;
  frame.index = kKeyframes + 1;
  const std::vector<PlaneMatch> matches = AssociatePlanes(frame, map, camera, {}).matches;
  EXPECT_EQ(matches.size(), 2u);
  for (const PlaneMatch& match : matches) EXPECT_EQ(match.decision, PlaneDecision::kMatched);
}

// The camera knows its place among landmarks of now to a tenth of a millimetre. One of long ago has
// drifted beyond what can be hidden, and is looked for from where it meets what is seen.
TEST(DriftedPose, JudgesTheOverlapWithALandmarkOfLongAgoWhereTheTwoMeet) {
  const auto weighed = [](double off_m) {
    const Return r = ReturnTo(kKeyframes, off_m);
    const UncertainPose pose{r.frame.T_cw, IsotropicCovariance(1e-4, 1e-4)};
    const UncertainPose predicted{r.frame.T_cw, IsotropicCovariance(0.02, 0.001)};
    PairRefusals refused;
    return WeighPairs(r.frame, r.map, pose, predicted, SmallCamera(), {}, refused).at(0).at(0);
  };
  const PairEvidence without_drift = weighed(0.0);
  ASSERT_GT(without_drift.overlap, 0.9);
  for (const double off_m : {-0.1, 0.1}) {
    const PairEvidence pair = weighed(off_m);
    EXPECT_EQ(pair.verdict, PairVerdict::kPossible) << off_m;
    EXPECT_NEAR(pair.overlap, without_drift.overlap, 0.05) << off_m;
    EXPECT_NEAR(pair.landed, without_drift.landed, 0.05 * without_drift.landed) << off_m;
  }
}

TEST(DriftedPose, IsCorrectedAsWellAsNoiseAndBendLetAFarPlaneTell) {
  FramePlane wall;
  wall.pi_c = {Eigen::Vector3d(0, 0, -1), 4.0};
  wall.centroid_c = {0, 0, 4};
  wall.offset_sigma_m = 0.001, wall.angle_sigma_rad = 1e-4;
  wall.bend_offset_sigma_m = 0.013, wall.bend_angle_sigma_rad = 0.002;
  Frame frame;
  frame.planes = {wall};
  MapPlane m;
  m.pi_w = wall.pi_c;
  m.centroid_w = wall.centroid_c;
  Map map;
  const int id = AddLandmark(map, m);
  UncertainPose predicted;
  predicted.covariance = 1e-12 * Matrix6d::Identity();
  predicted.covariance(2, 2) = 0.05 * 0.05;
  AssociationConfig config;
  config.offset_floor_m = 0.0;
  const UncertainPose corrected = CorrectPrediction(predicted, frame, map, {{0, id}}, config);
  const double by_wall = 0.001 * 0.001 + 0.013 * 0.013;
  EXPECT_NEAR(corrected.covariance(2, 2), 1 / (1 / (0.05 * 0.05) + 1 / by_wall),
              0.05 * by_wall);
}

PlaneWorld Desk(const Eigen::Vector3d& center_w) {
  PlaneWorld world;
  world.Add(center_w, {0.4, 0, 0}, {0, 0.3, 0}, "");
  return world;
}

/// The decision on a desk seen by a camera that thinks itself higher than it is, by so much; the map has
/// a desk at the origin.
PlaneDecision DecisionOn(const Eigen::Vector3d& center_w, double higher_m, double sigma_m) {
  const Camera camera = SmallCamera();
  const Pose first = LookAt({0, -0.9, 0.8}, {0, 0, 0}),
             second = LookAt({0.1, -0.9, 0.8}, {0, 0, 0});
  Map map;
  SeenWorld mapped = See(Desk({0, 0, 0}), first, camera, {}, Random{1});
  UpdatePlanes(mapped.frame, map, camera, {}, OneViewIsTheMap());
  Frame frame = See(Desk(center_w), second, camera, {}, Random{2}).frame;
  const Eigen::Vector3d up_c = frame.T_cw.R * Eigen::Vector3d::UnitZ();
  frame.T_cw.t -= higher_m * up_c;
  Matrix6d covariance = 1e-5 * Matrix6d::Identity();
  covariance.topLeftCorner<3, 3>() += sigma_m * sigma_m * up_c * up_c.transpose();
  frame.pose_covariance = covariance;
  return AssociatePlanes(frame, map, camera, {}).matches.at(0).decision;
}

TEST(UncertainPose, IsNoReasonNotToRecogniseADesk) {
  for (const double higher_m : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    SCOPED_TRACE(higher_m);
    EXPECT_EQ(DecisionOn({0, 0, 0}, higher_m, 0.15), PlaneDecision::kMatched);
  }
  for (const double higher_m : {-0.2, 0.2}) {
    EXPECT_EQ(DecisionOn({0, 0, 0}, higher_m, 0.01), PlaneDecision::kUnmatched) << higher_m;
  }
}

/// The same frame with its two planes in the other order.
Frame TurnedRound(const Frame& frame) {
  Frame turned = frame;
  std::swap(turned.planes[0], turned.planes[1]);
  turned.planes[0].index = 0, turned.planes[1].index = 1;
  for (std::uint8_t& label : turned.plane_labels) {
    if (label > 0) label = static_cast<std::uint8_t>(3 - label);
  }
  return turned;
}

// Of a desk the front half has become a board 10 cm lower, and the camera thinks itself as much higher.
// What is left of the desk moves the view for its own pair alone: the board, which is where the
// camera thinks that the desk is, is weighed from where the camera thinks it stands.
TEST(UncertainPose, IsCorrectedForEachPairAloneWhateverTheOrderOfThePlanes) {
  const Camera camera = SmallCamera();
  Map map;
  SeenWorld mapped =
      See(Desk({0, 0, 0}), LookAt({0, -0.9, 0.8}, {0, 0, 0}), camera, {}, Random{1});
  UpdatePlanes(mapped.frame, map, camera, {}, OneViewIsTheMap());
  PlaneWorld world;
  world.Add({0, 0.15, 0}, {0.4, 0, 0}, {0, 0.15, 0}, "");
  world.Add({0, -0.15, -0.1}, {0.4, 0, 0}, {0, 0.15, 0}, "");
  Frame frame = See(world, LookAt({0.1, -0.9, 0.8}, {0, 0, 0}), camera, {}, Random{2}).frame;
  ASSERT_EQ(frame.planes.size(), 2u);
  const Eigen::Vector3d up_c = frame.T_cw.R * Eigen::Vector3d::UnitZ();
  frame.T_cw.t -= 0.1 * up_c;
  UncertainPose pose = PredictedPose(frame);
  pose.covariance = 1e-5 * Matrix6d::Identity();
  pose.covariance.topLeftCorner<3, 3>() += 0.15 * 0.15 * up_c * up_c.transpose();
  const auto pairs_of = [&](const Frame& seen) {
    PairRefusals refused;
    return WeighPairs(seen, map, pose, pose, camera, {}, refused);
  };
  const PairTable pairs = pairs_of(frame), turned = pairs_of(TurnedRound(frame));
  for (std::size_t f = 0; f < 2; ++f) {
    ASSERT_EQ(pairs[f].size(), 1u);
    ASSERT_EQ(turned[1 - f].size(), 1u);
    EXPECT_GT(pairs[f][0].landed, 0) << f;
    EXPECT_EQ(pairs[f][0].landed, turned[1 - f][0].landed) << f;
    EXPECT_EQ(pairs[f][0].overlap, turned[1 - f][0].overlap) << f;
  }
}

TEST(UncertainPose, TakesNoDeskForOneBesideIt) {
  for (const double higher_m : {-0.2, 0.0, 0.2}) {
    EXPECT_EQ(DecisionOn({0.9, 0, 0}, higher_m, 0.15), PlaneDecision::kUnmatched) << higher_m;
  }
}

}  // namespace
}  // namespace slam
