#include "eval/trajectory/score_consistency.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <random>

namespace eval {
namespace {

using Vector6d = Eigen::Matrix<double, 6, 1>;

constexpr double kFps = 10.0, kHalfFrame_s = 0.05;

/// A motion that turns and goes on, so that axes of the camera are not those of the world and
/// levers are long.
Pose TrueAt(int i) {
  const Eigen::AngleAxisd turn(0.13 * i, Eigen::Vector3d(1, 2, -1).normalized());
  return {turn.toRotationMatrix(), {0.4 * i, std::cos(0.2 * i), 3.0 * std::sin(0.1 * i)}};
}

/// The true pose as it would be if the claimed one were off by xi, the other way round.
Pose Off(const Pose& T_gc, const Vector6d& xi) {
  const Eigen::Vector3d turn = xi.tail<3>();
  const Eigen::AngleAxisd R(turn.norm(), turn.normalized());
  return T_gc * Inverse(Pose{R.toRotationMatrix(), xi.head<3>()});
}

/// Directions that are known well and badly, and errors that go together.
Matrix6d SomeCovariance() {
  Matrix6d A;
  A << 1, 0, 0, 0, 2, 0,  //
      0, 3, 0, 0, 0, 0,   //
      0, 1, 9, 0, 0, 0,   //
      0, 0, 0, 1, 0, 0,   //
      2, 0, 0, 0, 1, 0,   //
      0, 0, 5, 0, 0, 2;
  return 1e-8 * A * A.transpose();
}

/// A world of the run of its own, to be laid on the truth.
const Alignment kGauge{
    1.0,
    {Eigen::AngleAxisd(1.1, Eigen::Vector3d(0, 1, 3).normalized()).toRotationMatrix(),
     {5, -2, 7}}};

/// Poses whose errors are drawn from a covariance of which `claimed` times is told; in every other
/// second both are `wide` times as large.
std::vector<ClaimedPose> Drawn(int count, double claimed, double wide = 1.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const Matrix6d C = SomeCovariance(), root = Eigen::LLT<Matrix6d>(C).matrixL();
  std::vector<ClaimedPose> poses;
  for (int i = 0; i < count; ++i) {
    Vector6d z;
    for (double& x : z) x = normal(random);
    const double times = i / 10 % 2 == 0 ? 1.0 : wide;
    const Pose T_gc = TrueAt(i);
    poses.push_back({i / kFps, Inverse(kGauge.T_gw) * Off(T_gc, std::sqrt(times) * root * z),
                     T_gc, times * claimed * C});
  }
  return poses;
}

TEST(ScoreConsistency, FindsAnHonestCovarianceHonest) {
  const ConsistencyScore score = ScoreConsistency(Drawn(4000, 1.0), kGauge, kHalfFrame_s);
  ASSERT_TRUE(score.absolute && score.relative);
  EXPECT_EQ(score.absolute->count, 4000u);
  EXPECT_EQ(score.relative->count, 3990u);
  for (const auto& claims : {*score.absolute, *score.relative}) {
    // Five standard deviations of the mean of 4000: sqrt(2 dof / 4000) each.
    EXPECT_NEAR(claims.position.mean, 3.0, 5 * 0.039);
    EXPECT_NEAR(claims.rotation.mean, 3.0, 5 * 0.039);
    EXPECT_NEAR(claims.pose.mean, 6.0, 5 * 0.055);
    EXPECT_NEAR(claims.pose.median, 5.35, 0.3);
    for (const Nees& kind : {claims.position, claims.rotation, claims.pose}) {
      EXPECT_NEAR(kind.inside, 0.95, 0.018);  // five standard deviations
      EXPECT_NEAR(kind.above, 0.025, 0.0125);
    }
    EXPECT_EQ(claims.silent, 0u);
  }
}

TEST(ScoreConsistency, CarriesTheCovarianceOfTheEarlierPoseToTheLaterOne) {
  // Of two poses a second apart one is known badly: whose it is tells where its axes point.
  const ConsistencyScore score =
      ScoreConsistency(Drawn(4000, 1.0, 100.0), kGauge, kHalfFrame_s);
  EXPECT_NEAR(score.absolute->pose.mean, 6.0, 5 * 0.055);
  EXPECT_NEAR(score.relative->pose.mean, 6.0, 5 * 0.055);
  EXPECT_NEAR(score.relative->pose.inside, 0.95, 0.02);
}

TEST(ScoreConsistency, TellsClaimsThatAreTooBoldAndTooTimid) {
  const ConsistencyScore bold = ScoreConsistency(Drawn(2000, 0.04), kGauge, kHalfFrame_s);
  EXPECT_NEAR(bold.absolute->pose.mean, 150.0, 10.0);
  EXPECT_LT(bold.absolute->pose.inside, 0.05);
  EXPECT_GT(bold.absolute->silent, 1000u);  // one sigma is five of the claimed ones
  const ConsistencyScore timid = ScoreConsistency(Drawn(2000, 25.0), kGauge, kHalfFrame_s);
  EXPECT_NEAR(timid.relative->pose.mean, 0.24, 0.02);
  EXPECT_LT(timid.relative->pose.inside, 0.1);
  EXPECT_EQ(timid.relative->pose.above, 0.0);
}

TEST(ScoreConsistency, CallsAFrameSilentThatIsFiveSigmaOffInItsBestKnownDirectionAlone) {
  // A millimetre along z is nothing where z is known to a metre, and ten sigmas along x.
  std::vector<ClaimedPose> poses;
  for (int i = 0; i < 3; ++i) {
    Vector6d variances;
    variances << 1e-8, 1, 1, 1, 1, 1e-8;
    poses.push_back({i / kFps, TrueAt(i), TrueAt(i), variances.asDiagonal()});
  }
  const auto silent = [&] {
    return ScoreConsistency(poses, Alignment{}, kHalfFrame_s).absolute->silent;
  };
  const auto off = [&](int axis, double by) {
    poses[1].T_wc = Off(TrueAt(1), by * Vector6d::Unit(axis));
    return silent();
  };
  EXPECT_EQ(off(2, 1e-3), 0u);
  EXPECT_EQ(off(0, 4.9e-4), 0u);
  EXPECT_EQ(off(0, 5.1e-4), 1u);
  EXPECT_EQ(off(4, 1e-3), 0u);
  EXPECT_EQ(off(5, 5.1e-4), 1u);
}

TEST(ScoreConsistency, DriftFromBeforeEntersTheAbsoluteErrorAlone) {
  std::vector<ClaimedPose> poses = Drawn(400, 1.0);
  const Pose drift{Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitY()).toRotationMatrix(),
                   {0.02, 0, 0}};
  for (std::size_t i = 200; i < poses.size(); ++i) poses[i].T_wc = drift * poses[i].T_wc;
  const ConsistencyScore score = ScoreConsistency(poses, kGauge, kHalfFrame_s);
  EXPECT_NEAR(static_cast<double>(score.absolute->silent), 200.0, 1.0);
  EXPECT_LE(score.relative->silent, 10u);  // pairs across the moment
}

TEST(ScoreConsistency, LeavesOutAPoseThatIsTheWorld) {
  std::vector<ClaimedPose> poses = Drawn(12, 1.0);
  poses[0].covariance.setZero();
  const ConsistencyScore score = ScoreConsistency(poses, kGauge, kHalfFrame_s);
  EXPECT_EQ(score.absolute->count, 11u);
  EXPECT_EQ(score.relative->count, 2u);  // the motion from there on has an error
}

TEST(ScoreConsistency, SaysWhyNothingIsDefined) {
  const ConsistencyScore none = ScoreConsistency({}, std::nullopt, kHalfFrame_s);
  EXPECT_FALSE(none.absolute || none.relative);
  EXPECT_EQ(none.no_absolute, "no pose with a covariance has a true pose of its time");
  EXPECT_EQ(none.no_relative, "no two matched poses with a covariance are 1 s apart");
}

TEST(ScoreConsistency, TellsCovarianceThatIsNoneFromPosesThatAreNotASecondApart) {
  std::vector<ClaimedPose> poses = Drawn(11, 1.0);
  for (ClaimedPose& pose : poses) pose.covariance.setZero();
  const ConsistencyScore score = ScoreConsistency(poses, kGauge, kHalfFrame_s);
  EXPECT_FALSE(score.absolute || score.relative);
  EXPECT_EQ(score.no_absolute, "no covariance is regular");
  EXPECT_EQ(score.no_relative, "no covariance of two poses 1 s apart is regular");
}

}  // namespace
}  // namespace eval
