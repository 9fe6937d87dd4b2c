// Bare trajectories against each other: what may not change a figure, and what is refused.
#include "eval/trajectory/compare_trajectories.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/support/refusal.h"

namespace eval {
namespace {

using ::testing::HasSubstr;

// Positions below 20 m through two alignments: some hundred operations, 1e2 * 20 * 2^-53.
constexpr double kRoundOff_m = 1e-12;
constexpr double kRoundOff_deg = 1e-6;  // angles near 0 are roots of round-off

Pose PoseOf(double x, double y, double z, double turn_rad) {
  return {
      Eigen::AngleAxisd(turn_rad, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix(),
      {x, y, z}};
}

/// A walk with loops of 200 poses, 20 a second.
PoseFile Walk() {
  PoseFile file{"truth.txt", PoseFileKind::kTum, {}, {}};
  for (int i = 0; i < 200; ++i) {
    const double s = 0.05 * i;
    file.poses.push_back(
        {s, PoseOf(2 * std::cos(s), 3 * std::sin(1.3 * s), 0.2 * s, 0.4 * s), i + 1});
  }
  return file;
}

PoseFile Noisy(PoseFile file) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.02);
  for (StampedPose& pose : file.poses) {
    pose.T_wc = pose.T_wc * PoseOf(noise(random), noise(random), noise(random), noise(random));
  }
  file.path = "estimate.txt";
  return file;
}

PoseFile Moved(const Pose& T, PoseFile file) {
  for (StampedPose& pose : file.poses) pose.T_wc = T * pose.T_wc;
  return file;
}

PoseFile Scaled(double scale, PoseFile file) {
  for (StampedPose& pose : file.poses) pose.T_wc.t *= scale;
  return file;
}

void ExpectSame(const TrajectoryComparison& a, const TrajectoryComparison& b) {
  EXPECT_EQ(a.pairs, b.pairs);
  for (const auto& [one, other] :
       {std::pair(a.absolute, b.absolute), std::pair(a.relative, b.relative)}) {
    EXPECT_NEAR(one.translation_m->rmse, other.translation_m->rmse, kRoundOff_m);
    EXPECT_NEAR(one.translation_m->max, other.translation_m->max, kRoundOff_m);
    EXPECT_NEAR(one.rotation_deg->rmse, other.rotation_deg->rmse, kRoundOff_deg);
  }
}

const Pose kElsewhere = PoseOf(3, -5, 1, 2.5);

ComparisonRules With(AlignMode align, PoseDelta delta = {}) {
  ComparisonRules rules;
  rules.align = align;
  rules.delta = delta;
  rules.pairs = PairMode::kAll;
  return rules;
}

TEST(CompareTrajectories, MovingEitherFileRigidlyChangesNothingUnderSe3) {
  const PoseFile truth = Walk(), estimate = Noisy(truth);
  for (const PoseDelta delta : {PoseDelta{1, DeltaUnit::kFrames},
                                {1, DeltaUnit::kMetres},
                                {1, DeltaUnit::kSeconds},
                                {10, DeltaUnit::kDegrees}}) {
    const ComparisonRules rules = With(AlignMode::kSe3, delta);
    const auto as_it_is = CompareTrajectories(estimate, truth, rules);
    ASSERT_GT(as_it_is.pairs, 100u);
    ExpectSame(CompareTrajectories(Moved(kElsewhere, estimate), truth, rules), as_it_is);
    ExpectSame(
        CompareTrajectories(Moved(kElsewhere, estimate), Moved(kElsewhere, truth), rules),
        as_it_is);
  }
}

TEST(CompareTrajectories, MovingBothFilesRigidlyChangesNothingUnderNoneAndOrigin) {
  const PoseFile truth = Walk(), estimate = Noisy(truth);
  for (const AlignMode mode : {AlignMode::kNone, AlignMode::kOrigin}) {
    ExpectSame(
        CompareTrajectories(Moved(kElsewhere, estimate), Moved(kElsewhere, truth), With(mode)),
        CompareTrajectories(estimate, truth, With(mode)));
  }
}

TEST(CompareTrajectories, ScalingTheEstimateChangesNothingUnderSim3ButItsScale) {
  const PoseFile truth = Walk(), estimate = Noisy(truth);
  const auto one = CompareTrajectories(estimate, truth, With(AlignMode::kSim3));
  const auto other = CompareTrajectories(Scaled(4.0, estimate), truth, With(AlignMode::kSim3));
  ExpectSame(one, other);
  EXPECT_NEAR(other.scale, one.scale / 4.0, 1e-14);
  const auto unscaled =
      CompareTrajectories(Scaled(4.0, estimate), truth, With(AlignMode::kSe3));
  EXPECT_GT(unscaled.absolute.translation_m->rmse, 1.0);
}

TEST(CompareTrajectories, ProjectsToAPlaneAsEvoDoes) {
  // R = Rz(0.3) Ry(-0.2) Rx(0.1): each plane keeps the one angle about its normal.
  const Pose pose{(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY()) *
                   Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix(),
                  {1, 2, 3}};
  const auto angle_about = [](const Pose& flat, int axis) {
    return Eigen::AngleAxisd(flat.R).axis()[axis] * Eigen::AngleAxisd(flat.R).angle();
  };
  const Pose xy = Project(pose, ProjectionPlane::kXy), xz = Project(pose, ProjectionPlane::kXz);
  const Pose yz = Project(pose, ProjectionPlane::kYz);
  EXPECT_EQ(xy.t, Eigen::Vector3d(1, 2, 0));
  EXPECT_EQ(xz.t, Eigen::Vector3d(1, 0, 3));
  EXPECT_EQ(yz.t, Eigen::Vector3d(0, 2, 3));
  EXPECT_NEAR(angle_about(xy, 2), 0.3, 1e-14);
  EXPECT_NEAR(angle_about(xz, 1), -0.2, 1e-14);
  EXPECT_NEAR(angle_about(yz, 0), 0.1, 1e-14);
}

TEST(CompareTrajectories, ErrorsAcrossThePlaneDoNotCountInIt) {
  const PoseFile truth = Walk();
  PoseFile estimate = truth;
  for (StampedPose& pose : estimate.poses) pose.T_wc.t.z() += std::sin(pose.stamp_s);
  ComparisonRules rules = With(AlignMode::kNone);
  EXPECT_GT(CompareTrajectories(estimate, truth, rules).absolute.translation_m->rmse, 0.5);
  rules.plane = ProjectionPlane::kXy;
  EXPECT_LT(CompareTrajectories(estimate, truth, rules).absolute.translation_m->rmse,
            kRoundOff_m);
}

/// R = Rz Ry Rx.
Eigen::Matrix3d FromAngles(const Eigen::Vector3d& angles_rad) {
  return (Eigen::AngleAxisd(angles_rad.z(), Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles_rad.y(), Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles_rad.x(), Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

// A circle in each plane, and an estimate of it with errors that are known in closed form: a step
// in the plane and a turn about its normal count, the step across and the tilts do not.
TEST(CompareTrajectories, ErrorsInThePlaneAreThoseOfFlatPoses) {
  const std::pair<ProjectionPlane, int> planes[] = {
      {ProjectionPlane::kXy, 2}, {ProjectionPlane::kXz, 1}, {ProjectionPlane::kYz, 0}};
  for (const auto& [plane, across] : planes) {
    PoseFile truth, estimate;
    const Eigen::Vector3d n = Eigen::Vector3d::Unit(across);
    const Eigen::Vector3d u = Eigen::Vector3d::Unit((across + 1) % 3);
    const Eigen::Vector3d v = Eigen::Vector3d::Unit((across + 2) % 3);
    constexpr int kPoses = 100;
    constexpr double kTurn_rad = 0.02;
    for (int i = 0; i < kPoses; ++i) {
      const double a = 2 * M_PI * i / kPoses;
      StampedPose seen;
      seen.stamp_s = i / 30.0;
      seen.T_wc.t = std::cos(a) * u + std::sin(a) * v;
      Eigen::Vector3d angles = 0.3 * std::sin(a) * n;
      seen.T_wc.R = FromAngles(angles);
      truth.poses.push_back(seen);
      // 3 mm, 4 mm and a turn in the plane, 50 mm and tilts across it.
      seen.T_wc.t += 0.003 * u - 0.004 * v + 0.05 * std::cos(3 * a) * n;
      angles += kTurn_rad * n + 0.2 * std::sin(a) * u - 0.1 * std::cos(2 * a) * v;
      seen.T_wc.R = FromAngles(angles);
      estimate.poses.push_back(seen);
    }
    ComparisonRules rules = With(AlignMode::kNone);
    rules.plane = plane;
    const TrajectoryComparison flat = CompareTrajectories(estimate, truth, rules);
    EXPECT_NEAR(flat.absolute.translation_m->rmse, 0.005, 1e-9 * 0.005);
    EXPECT_NEAR(flat.absolute.translation_m->max, 0.005, 1e-9 * 0.005);
    EXPECT_NEAR(flat.absolute.rotation_deg->mean, kTurn_rad * 180 / M_PI, 1e-9);
    // |E - I| of a turn and a step: two entries each of cos - 1 and sin.
    const double full = std::sqrt(4 - 4 * std::cos(kTurn_rad) + 0.005 * 0.005);
    EXPECT_NEAR(flat.absolute.full->rmse, full, 1e-9 * full);
    // From one pose to the next the constant step and turn cancel but for the turn of the step:
    // the estimate's motion is the truth's, turned back by the constant turn.
    const double chord = 2 * std::sin(M_PI / kPoses);
    const double relative = 2 * std::sin(kTurn_rad / 2) * chord;
    EXPECT_NEAR(flat.relative.translation_m->rmse, relative, 1e-9 * relative);
    EXPECT_NEAR(flat.relative.rotation_deg->max, 0.0, 1e-6);
    EXPECT_GT(CompareTrajectories(estimate, truth, With(AlignMode::kNone))
                  .absolute.translation_m->rmse,
              0.03);
  }
}

TEST(CompareTrajectories, SaysWhyAStraightPathHasNoAlignmentAndKeepsItsRelativeErrors) {
  PoseFile truth = Walk();
  for (StampedPose& pose : truth.poses) pose.T_wc.t = {pose.stamp_s, 0, 0};
  const auto score = CompareTrajectories(truth, truth, With(AlignMode::kSe3));
  EXPECT_FALSE(score.absolute.translation_m);
  EXPECT_THAT(score.no_absolute, HasSubstr("line"));
  ASSERT_TRUE(score.relative.translation_m);
  EXPECT_LT(score.relative.translation_m->rmse, kRoundOff_m);
  const auto scaled = CompareTrajectories(truth, truth, With(AlignMode::kSim3));
  EXPECT_FALSE(scaled.relative.translation_m);
  EXPECT_THAT(scaled.no_relative, HasSubstr("line"));
}

// Without an alignment the estimate's world has any attitude, and with it any shadow on the plane.
TEST(CompareTrajectories, HasNoErrorsInAPlaneWhereAStraightPathHasNoAlignment) {
  PoseFile truth = Walk();
  for (StampedPose& pose : truth.poses) pose.T_wc.t = {pose.stamp_s, 0, 0};
  for (const ProjectionPlane plane :
       {ProjectionPlane::kXy, ProjectionPlane::kXz, ProjectionPlane::kYz}) {
    ComparisonRules rules = With(AlignMode::kSe3);
    rules.plane = plane;
    for (const PoseFile& estimate : {truth, Moved(kElsewhere, truth)}) {
      const auto score = CompareTrajectories(estimate, truth, rules);
      EXPECT_FALSE(score.absolute.translation_m || score.absolute.rotation_deg);
      EXPECT_FALSE(score.relative.translation_m || score.relative.rotation_deg);
      EXPECT_THAT(score.no_relative, HasSubstr("line"));
    }
  }
}

/// Ten poses a second that each go 0.1 m and turn by a degree, `times` as far.
PoseFile Steady(double times) {
  PoseFile file{"steady.txt", PoseFileKind::kTum, {}, {}};
  for (int i = 0; i < 60; ++i) {
    const double turn_rad = times * i * std::numbers::pi / 180.0;
    file.poses.push_back(
        {0.1 * i,
         {Eigen::AngleAxisd(turn_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
          {0, 0, 0.1 * times * i}},
         i + 1});
  }
  return file;
}

// Where the estimate goes and turns twice as far, a metre of it is half a metre of the truth: its
// error over pairs of n poses is 0.1 n metres and n degrees.
TEST(CompareTrajectories, TakesPairsAlongTheEstimateOrAlongTheTruthAsItIsAsked) {
  for (const PairMode mode : {PairMode::kConsecutive, PairMode::kAll}) {
    for (const bool from_truth : {false, true}) {
      for (const PoseDelta delta :
           {PoseDelta{1.04, DeltaUnit::kMetres}, PoseDelta{10.5, DeltaUnit::kDegrees}}) {
        SCOPED_TRACE(::testing::Message()
                     << (mode == PairMode::kAll ? "all" : "in turn")
                     << (from_truth ? ", truth " : ", estimate ") << delta.value);
        ComparisonRules rules = With(AlignMode::kNone, delta);
        rules.pairs = mode;
        rules.pairs_from_truth = from_truth;
        const auto score = CompareTrajectories(Steady(2), Steady(1), rules);
        ASSERT_TRUE(score.relative.translation_m);
        // In turn the first that is far enough ends a pair, of all those the nearest.
        const bool in_turn = mode == PairMode::kConsecutive;
        const double poses = in_turn ? (from_truth ? 11 : 6) : (from_truth ? 10.5 : 5);
        const double slack = in_turn ? 1e-9 : 0.51;  // 10 and 11 degrees are as near
        EXPECT_NEAR(score.relative.translation_m->mean / 0.1, poses, slack);
        EXPECT_NEAR(score.relative.rotation_deg->mean, poses, slack);
      }
    }
  }
}

TEST(CompareTrajectories, TakesPairsOfSecondsThatMissByLessThanHalfAFrame) {
  PoseFile truth = Steady(1);
  // One pair of 0.5 s began with the pose that is gone, and one ended with it.
  truth.poses.erase(truth.poses.begin() + 30);
  ComparisonRules rules = With(AlignMode::kNone, {0.5, DeltaUnit::kSeconds});
  EXPECT_EQ(CompareTrajectories(truth, truth, rules).pairs, 60u - 5u - 2u);
  rules.delta.value = 0.54;
  EXPECT_EQ(CompareTrajectories(truth, truth, rules).pairs, 60u - 5u - 2u);
}

TEST(CompareTrajectories, SaysThatNoTwoPosesAreThatFarApart) {
  const auto score =
      CompareTrajectories(Walk(), Walk(), With(AlignMode::kSe3, {500, DeltaUnit::kMetres}));
  EXPECT_EQ(score.pairs, 0u);
  EXPECT_FALSE(score.relative.translation_m);
  EXPECT_THAT(score.no_relative, HasSubstr("far apart"));
}

std::string ErrorOf(const PoseFile& estimate, const PoseFile& truth) {
  return test_support::RefusalOf([&] { CompareTrajectories(estimate, truth, {}); });
}

TEST(CompareTrajectories, RefusesFilesThatShareNoTime) {
  PoseFile later = Walk();
  for (StampedPose& pose : later.poses) pose.stamp_s += 1000.0;
  EXPECT_THAT(
      ErrorOf(later, Walk()),
      HasSubstr("none of its 200 poses (1000.000 to 1009.950 s) have a true pose within "
                "0.01 s in truth.txt (0.000 to 9.950 s)"));
}

TEST(CompareTrajectories, RefusesAClockBesideNoneAndKittiFilesOfOtherLengths) {
  PoseFile counted = Walk();
  counted.kind = PoseFileKind::kKitti;
  EXPECT_THAT(ErrorOf(counted, Walk()), HasSubstr("KITTI's have no times"));
  PoseFile shorter = counted;
  shorter.poses.pop_back();
  EXPECT_THAT(ErrorOf(shorter, counted),
              HasSubstr("has 199 poses, the truth truth.txt has 200"));
}

}  // namespace
}  // namespace eval
