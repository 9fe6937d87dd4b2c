#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "eval/formats/sequence/sequence.h"
#include "eval/trajectory/pairs.h"
#include "eval/trajectory/score_trajectory.h"
#include "tests/support/shared_data.h"

namespace eval {
namespace {

constexpr double kExact_m = 1e-12;  // a few metres, a few operations

Trajectory Helix(int count, double fps) {
  Trajectory poses;
  for (int i = 0; i < count; ++i) {
    const double a = 0.1 * i;
    poses.push_back(
        {i / fps, {Eigen::Matrix3d::Identity(), {std::cos(a), std::sin(a), 0.01 * i}}});
  }
  return poses;
}

std::vector<double> Stamps(const Trajectory& poses) {
  std::vector<double> stamps_s;
  for (const StampedPose& pose : poses) stamps_s.push_back(pose.stamp_s);
  return stamps_s;
}

TEST(PairsByTime, PairsFramesOneSecondApartWhateverTheRate) {
  for (const double fps : {10.0, 25.0, 30.0}) {
    const std::vector<double> stamps_s = Stamps(Helix(100, fps));
    const auto pairs = PairsByTime(stamps_s, 1.0, 0.5 / fps);
    ASSERT_EQ(pairs.size(), std::size_t(100 - fps)) << fps;
    for (const auto& [i, j] : pairs) EXPECT_EQ(j - i, std::size_t(fps));
  }
}

TEST(PairsByTime, DoesNotBridgeAGapOfTheRun) {
  std::vector<double> stamps_s = {0.0, 0.1, 0.2, 5.0, 5.1, 6.0};
  const auto pairs = PairsByTime(stamps_s, 1.0, 0.05);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0], PosePair(3, 5));
}

TEST(MatchNearest, ReusesATruthAndTakesTheFirstOfEquallyNearOnes) {
  const Trajectory truth = {{0.0, {}}, {0.01, {}}, {0.02, {}}, {0.03, {}}, {0.04, {}}};
  const Trajectory burst = {{0.0101, {}}, {0.0102, {}}, {0.5, {}}};
  const auto matches = MatchNearest(truth, burst);
  ASSERT_EQ(matches.size(), 2u);
  EXPECT_EQ(matches[0].truth, 1u);
  EXPECT_EQ(matches[1].truth, 1u);
  const auto tie = MatchNearest({{0.0, {}}, {0.25, {}}}, {{0.125, {}}}, 0.125);
  ASSERT_EQ(tie.size(), 1u);
  EXPECT_EQ(tie[0].truth, 0u);  // and the limit itself is kept
}

TEST(ScoreTrajectory, CountsEachLossButNotTheStartBeforeTheFirstPose) {
  const Trajectory truth = Helix(20, 30.0);
  Trajectory estimate(truth.begin() + 3, truth.end());
  estimate.erase(estimate.begin() + 10, estimate.begin() + 12);
  estimate.pop_back();
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true);
  EXPECT_EQ(score.frames, 20u);
  EXPECT_EQ(score.tracked, 14u);
  EXPECT_EQ(score.lost_events, 2u);
}

TEST(ScoreTrajectory, ChargesAMissingFrameTheDiameterOfTheTruePath) {
  const Trajectory truth = Helix(64, 30.0);
  Trajectory estimate = truth;
  estimate.erase(estimate.begin() + 10);
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true);
  double diameter_m = 0.0;
  for (const auto& a : truth) {
    for (const auto& b : truth) {
      diameter_m = std::max(diameter_m, (a.T_wc.t - b.T_wc.t).norm());
    }
  }
  EXPECT_NEAR(score.ate_se3->rmse, 0.0, kExact_m);
  EXPECT_NEAR(*score.ate_complete_rmse_m, diameter_m / std::sqrt(64.0), kExact_m);
}

TEST(ScoreTrajectory, ChargesTheFramesThatARunWithMorePosesThanFramesHasLost) {
  // Truth and poses at ten times the rate of the frames, as of an IMU; lost for the second half.
  const Trajectory truth = Helix(640, 200.0);
  std::vector<double> frames_s;
  for (std::size_t i = 0; i < truth.size(); i += 10) frames_s.push_back(truth[i].stamp_s);
  Trajectory estimate(truth.begin(), truth.begin() + 316);
  for (const bool equal : {false, true}) {
    SCOPED_TRACE(equal);
    const TrajectoryScore score = ScoreTrajectory(estimate, truth, frames_s, equal);
    EXPECT_EQ(score.tracked, 32u);
    double diameter_m = 0.0;
    for (const auto& a : score.true_positions_g) {
      for (const auto& b : score.true_positions_g) {
        diameter_m = std::max(diameter_m, (a - b).norm());
      }
    }
    EXPECT_NEAR(*score.ate_complete_rmse_m, diameter_m / std::sqrt(2.0), 1e-9);
    const TrajectoryScore whole = ScoreTrajectory(truth, truth, frames_s, equal);
    EXPECT_NEAR(*whole.ate_complete_rmse_m, 0.0, 1e-9);
  }
}

TEST(ScoreTrajectory, LetsAPoseAnswerForOneFrameOnly) {
  // Frames 5 ms apart, within the tolerance of a recording; every second one has a pose.
  const Trajectory truth = Helix(64, 200.0);
  Trajectory estimate;
  for (std::size_t i = 0; i < truth.size(); i += 2) estimate.push_back(truth[i]);
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), false);
  EXPECT_GT(*score.ate_complete_rmse_m, 1.0);
}

TEST(ScoreTrajectory, PairsAMetreApartAlongTheTruthWhateverTheRunMakesOfIt) {
  constexpr std::size_t kSteps = 5;  // of 0.2 m each
  Trajectory truth = Helix(60, 30.0);
  for (StampedPose& pose : truth) pose.T_wc.t *= 2;
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.T_wc.t *= 2;
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true);
  ASSERT_TRUE(score.rpe_1m.has_value());
  EXPECT_EQ(score.rpe_1m->pairs, truth.size() - kSteps);
  EXPECT_NEAR(score.rpe_1m->trans_rmse_m, (truth[kSteps].T_wc.t - truth[0].T_wc.t).norm(),
              kExact_m);
}

TEST(ScoreTrajectory, SaysNotDefinedForACameraOnARail) {
  Trajectory rail;
  for (int i = 0; i < 40; ++i)
    rail.push_back(
        {i / 30.0, {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1 * i, 0.2 * i, 0)}});
  const TrajectoryScore score = ScoreTrajectory(rail, rail, Stamps(rail), true);
  EXPECT_FALSE(score.ate_se3.has_value());
  EXPECT_FALSE(score.ate_complete_rmse_m.has_value());
  EXPECT_TRUE(score.ate_origin.has_value());
  EXPECT_TRUE(score.gauge.has_value());
  EXPECT_TRUE(score.rpe_1s.has_value());
}

// On a line or with two poses the rotations still tell where the run's path lies in the truth.
TEST(ScoreTrajectory, LaysThePathOnTheTruthWherePositionsAloneAreNotEnough) {
  const Pose T_wg{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix(),
                  Eigen::Vector3d(0.4, -1.1, 0.2)};
  for (const int count : {2, 40}) {
    Trajectory rail;
    for (int i = 0; i < count; ++i) {
      rail.push_back({i / 30.0, {Eigen::Matrix3d::Identity(), {0.1 * i, 0.2 * i, 0.3}}});
    }
    Trajectory estimate = rail;
    for (StampedPose& pose : estimate) pose.T_wc = T_wg * pose.T_wc;
    const TrajectoryScore score = ScoreTrajectory(estimate, rail, Stamps(rail), true);
    ASSERT_EQ(score.errors.size(), rail.size());
    for (std::size_t i = 0; i < rail.size(); ++i) {
      const PoseError& error = score.errors[i];
      EXPECT_FALSE(error.position_m.has_value());
      ASSERT_TRUE(error.position_g.has_value()) << count;
      EXPECT_NEAR((*error.position_g - rail[i].T_wc.t).norm(), 0.0, kExact_m);
    }
  }
}

// Positions that are off on one side of the path tilt what is laid on positions alone.
TEST(ScoreTrajectory, HoldsRotationsToTheTruthByWholePoses) {
  const Trajectory truth = Helix(60, 30.0);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) pose.T_wc.t.z() += 0.3 * pose.T_wc.t.x();
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true);
  ASSERT_EQ(score.errors.size(), truth.size());
  for (const PoseError& error : score.errors) {
    EXPECT_NEAR(error.rotation_deg.value(), 0.0, 1e-6);
    EXPECT_GT(error.position_m.value(), 0.0);
  }
}

/// Position error of a millimetre and rotation error of a tenth of a degree on a path of `count`
/// poses; the angle between the world of the truth and where the gauge lays it.
double GaugeErrorDeg(Trajectory truth, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> position_m(0.0, 0.001), angle_rad(0.0, 0.0017);
  const Pose T_wg{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix(),
                  Eigen::Vector3d(0.4, -1.1, 0.2)};
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate) {
    pose.T_wc = T_wg * pose.T_wc;
    for (int axis = 0; axis < 3; ++axis) {
      pose.T_wc.t[axis] += position_m(random);
      pose.T_wc.R *=
          Eigen::AngleAxisd(angle_rad(random), Eigen::Vector3d::Unit(axis)).toRotationMatrix();
    }
  }
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true);
  return AngleOf(score.gauge.value().T_gw.R * T_wg.R) * 180.0 / std::numbers::pi;
}

TEST(MapGauge, IsAsGoodAsTheRotationsOnAShortPath) {
  for (const int count : {6, 12, 30}) {
    Trajectory path = Helix(count, 30.0);
    for (StampedPose& pose : path) pose.T_wc.t *= 0.02;  // 2 mm a frame
    EXPECT_LT(GaugeErrorDeg(path, 1), 0.2) << count;
  }
}

TEST(MapGauge, IsAsGoodAsTheRotationsOnALineWithJitter) {
  Trajectory rail;
  for (int i = 0; i < 60; ++i) {
    rail.push_back({i / 30.0, {Eigen::Matrix3d::Identity(), {0.01 * i, 0.02 * i, 0.0}}});
  }
  EXPECT_LT(GaugeErrorDeg(rail, 2), 0.2);
}

TEST(MapGauge, IsNotDefinedWhereRotationsContradictEachOther) {
  const Trajectory truth = Helix(2, 30.0);
  Trajectory estimate = truth;
  estimate[1].T_wc.R = Eigen::Vector3d(1, -1, -1).asDiagonal();  // half a turn about x
  EXPECT_FALSE(ScoreTrajectory(estimate, truth, Stamps(truth), true).gauge.has_value());
}

TEST(ScoreTrajectory, SaysNotDefinedForACameraOnATripod) {
  const Trajectory moving = Helix(40, 30.0);
  Trajectory tripod = moving;
  for (StampedPose& pose : tripod) pose.T_wc.t = Eigen::Vector3d(0.1, 123.7, 0.3);
  EXPECT_FALSE(ScoreTrajectory(moving, tripod, Stamps(tripod), true).ate_se3.has_value());
  EXPECT_FALSE(ScoreTrajectory(tripod, tripod, Stamps(tripod), true).ate_se3.has_value());
  EXPECT_FALSE(ScoreTrajectory(tripod, moving, Stamps(tripod), true).ate_se3.has_value());
}

TEST(ScoreTrajectory, ChargesEveryFrameOfARunThatNeverStarted) {
  const Trajectory truth = Helix(64, 30.0);
  const TrajectoryScore score = ScoreTrajectory({}, truth, Stamps(truth), true);
  EXPECT_EQ(score.tracked, 0u);
  EXPECT_FALSE(score.ate_se3 || score.ate_origin || score.gauge);
  EXPECT_GT(*score.ate_complete_rmse_m, 2.0);
}

TEST(ScoreTrajectory, HoldsAPoseAgainstTheCovarianceOfItsOwnTime) {
  const Trajectory truth = Helix(60, 10.0);
  Trajectory estimate = truth;
  std::vector<PoseCovariance> told;  // of every third pose, each of another size
  for (std::size_t i = 1; i < truth.size(); i += 3) {
    const double sigma_m = i / 3 % 2 == 0 ? 0.001 : 0.01;
    estimate[i].T_wc.t.x() += i / 6 % 2 == 0 ? sigma_m : -sigma_m;
    told.push_back({truth[i].stamp_s, sigma_m * sigma_m * Matrix6d::Identity()});
  }
  const TrajectoryScore score = ScoreTrajectory(estimate, truth, Stamps(truth), true, &told);
  ASSERT_TRUE(score.consistency && score.consistency->absolute);
  EXPECT_EQ(score.consistency->absolute->count, 20u);
  EXPECT_NEAR(score.consistency->absolute->position.mean, 1.0, 0.1);
}

TEST(ScoreTrajectory, ScoresARecordingWhoseTruthHasItsOwnClock) {
  const std::filesystem::path folder = test_support::TumRecording();
  SKIP_WITHOUT(folder);
  const Sequence sequence = ReadSequence(folder);
  std::vector<double> stamps_s;
  Trajectory estimate;
  for (const SequenceFrame& frame : sequence.frames) stamps_s.push_back(frame.stamp_s);
  const auto poses = TruePosesOfFrames(*sequence.groundtruth, stamps_s, false);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    ASSERT_TRUE(poses[i].has_value());
    estimate.push_back({stamps_s[i], *poses[i]});
  }
  const TrajectoryScore score =
      ScoreTrajectory(estimate, *sequence.groundtruth, stamps_s, false);
  EXPECT_EQ(score.tracked, 37u);
  EXPECT_EQ(score.ate_se3->count, 37u);
  EXPECT_NEAR(score.ate_se3->rmse, 0.0, kExact_m);
  EXPECT_TRUE(score.rpe_1s.has_value());
}

}  // namespace
}  // namespace eval
