#include "slam/associate/plane_comparison.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "slam/associate/correct_prediction.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

AssociationConfig TinyFloors() {
  AssociationConfig config;
  config.offset_floor_m = 1e-6;
  config.angle_floor_rad = 1e-6;
  return config;
}

FramePlane PatchAt(const Eigen::Vector3d& centroid_c, const Eigen::Vector3d& n_c,
                   double offset_sigma_m, double angle_sigma_rad) {
  FramePlane plane;
  plane.pi_c.n = n_c.normalized();
  plane.pi_c.d = -plane.pi_c.n.dot(centroid_c);
  plane.centroid_c = centroid_c;
  plane.offset_sigma_m = offset_sigma_m;
  plane.angle_sigma_rad = angle_sigma_rad;
  return plane;
}

TEST(PlaneEvidence, WidensTheOffsetByTheLeverOfTheOtherPatchWhateverItsDirection) {
  const AssociationConfig config;
  const Eigen::Vector3d facing(0, 0, -1), middle_c(0.2, 0.1, 2.0);
  for (const double angle : {0.0, 0.4, M_PI / 2, 2.5}) {
    const Eigen::Vector3d aside(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0);
    const FramePlane one = PatchAt(middle_c, facing, 0.002, 0.01);
    const FramePlane other = PatchAt(middle_c + aside, facing, 0.003, 0.02);
    const double floor2 = config.offset_floor_m * config.offset_floor_m;
    EXPECT_NEAR(ComparePlanes(one, other, config).offset_sigma_m,
                std::sqrt(2 * floor2 + 4e-6 + 9e-6 + 0.02 * 0.02 * 0.25), 1e-12);
  }
}

TEST(PlaneEvidence, IsSpreadByWhatMapPlaneAndPoseAreNotKnownByAlone) {
  // Height and two slopes, each k times as uncertain as by the patch's own errors: 3 ln k^2.
  const FramePlane seen = PatchAt({0, 0, 1.5}, {0, 0, -1}, 0.002, 0.01);
  MapPlane m;
  m.pi_w = seen.pi_c;
  m.centroid_w = seen.centroid_c;
  const auto spread = [&](double sigma) {
    UncertainPose pose;
    pose.covariance = sigma * sigma * Matrix6d::Identity();
    return ComparePlanes(seen, m, pose, TinyFloors()).log_spread;
  };
  // 3 mm and 10 mrad of a map plane without an estimate, by the side of 2 mm and 10 mrad.
  EXPECT_NEAR(spread(0.0), std::log(13.0 / 4.0) + 2 * std::log(2.0), 1e-6);
  EXPECT_GT(spread(0.01), spread(0.0) + 0.5);
}

TEST(PlaneEvidence, KnowsThatASensorWhichBendsMeasuresWorse) {
  // Height and tilt that are three sigmas of the fit are one of fit and bend.
  const FramePlane one = PatchAt({0, 0, 1.5}, {0, 0, -1}, 1e-5, 1e-5);
  FramePlane other = PatchAt({0, 0, 1.503}, {0.02, 0, -1}, 0.001, 0.02 / 3);
  const double unbent = ComparePlanes(other, one, TinyFloors()).chi2;
  EXPECT_NEAR(unbent, 18.0, 0.2);
  other.bend_offset_sigma_m = 0.001 * std::sqrt(8.0);
  other.bend_angle_sigma_rad = 0.02 / 3 * std::sqrt(8.0);
  EXPECT_NEAR(ComparePlanes(other, one, TinyFloors()).chi2, unbent / 9, 0.02);
}

TEST(PlaneEvidence, ExplainsByOneSlopeBothTheTiltAndTheHeightThatItMakes) {
  // The other patch is tilted about its own middle by one sigma of its slope: nothing else is
  // wrong, at its own place or half a metre from it.
  const double tilt_rad = 0.02;
  const Eigen::Vector3d middle_c(0.1, -0.2, 2.0);
  for (const Eigen::Vector3d& axis :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(-0.6, 0.8, 0)}) {
    for (const Eigen::Vector3d& aside :
         {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(0.1, -0.5, 0)}) {
      const Eigen::Vector3d facing(0, 0, -1);
      const FramePlane one = PatchAt(middle_c + aside, facing, 1e-5, 1e-5);
      const FramePlane other =
          PatchAt(middle_c, ExpSo3(tilt_rad * axis) * facing, 1e-5, tilt_rad);
      EXPECT_NEAR(ComparePlanes(one, other, TinyFloors()).chi2, 1.0, 0.01);
    }
  }
}

TEST(PlaneEvidence, ExplainsWhatAPoseErrorOfOneSigmaDoesInWhateverDirection) {
  MapPlane m;
  m.pi_w.n = Eigen::Vector3d(0.3, -0.2, -0.9).normalized();
  m.centroid_w = {0.4, 0.3, 2.0};
  m.pi_w.d = -m.pi_w.n.dot(m.centroid_w);
  AddObservation(m.estimate, m.pi_w, m.centroid_w, 1e-6, 1e-6, 1.0);
  const Pose truth_cw{ExpSo3({0.1, 0.3, -0.2}), {0.2, -0.1, 0.1}};
  FramePlane f = PatchAt(truth_cw * m.centroid_w, truth_cw.R * m.pi_w.n, 1e-6, 1e-6);
  constexpr double kSigma = 0.0005;
  std::vector<Vector6d> directions;
  for (int k = 0; k < 6; ++k) directions.push_back(Vector6d::Unit(k));
  // A step and a turn that go together, as those of a camera on an arm.
  for (const double sign : {-1.0, 1.0})
    for (int k = 0; k < 3; ++k)
      directions.push_back(Vector6d::Ones() + sign * 2.0 * Vector6d::Unit(k));
  for (const Vector6d& direction : directions) {
    UncertainPose pose;
    pose.T_cw = Exp(kSigma * direction) * truth_cw;
    pose.covariance = kSigma * kSigma * direction * direction.transpose();
    // What is of second order lies across the one direction that is allowed for.
    const double second_order = direction.norm() > 1 ? 0.15 : 0.06;
    EXPECT_NEAR(ComparePlanes(f, m, pose, TinyFloors()).chi2, 1.0, second_order)
        << direction.transpose();
  }
}

TEST(PlaneEvidence, ExplainsTheDriftOfAsManyLinksAsLieBetween) {
  // Each link errs at random, as its covariance says. What the camera measures is exact.
  constexpr int kDraws = 500;
  MapPlane m;
  m.pi_w.n = Eigen::Vector3d(0.3, -0.2, -0.9).normalized();
  m.centroid_w = {0.4, 0.3, 2.0};
  m.pi_w.d = -m.pi_w.n.dot(m.centroid_w);
  AddObservation(m.estimate, m.pi_w, m.centroid_w, 1e-6, 1e-6, 1.0);
  const Pose truth_cw{ExpSo3({0.1, 0.3, -0.2}), {0.2, -0.1, 0.1}};
  const FramePlane f = PatchAt(truth_cw * m.centroid_w, truth_cw.R * m.pi_w.n, 1e-6, 1e-6);
  const Vector6d sigmas = (Vector6d() << 4, 2, 3, 0.5, 1, 2).finished() * 1e-4;
  UncertainPose predicted;
  predicted.covariance = sigmas.cwiseAbs2().asDiagonal();
  Random random{5};
  for (const int links : {0, 3, 20}) {
    double sum = 0.0;
    for (int draw = 0; draw < kDraws; ++draw) {
      predicted.T_cw = truth_cw;
      for (int k = 0; k <= links; ++k) {
        Vector6d error;
        for (int i = 0; i < 6; ++i) error[i] = sigmas[i] * Normal(random);
        predicted.T_cw = Exp(error) * predicted.T_cw;
      }
      sum += ComparePlanes(f, m, WithDrift(predicted, predicted, links), TinyFloors()).chi2;
    }
    // 3 degrees of freedom; the mean's standard deviation is sqrt(6 / draws).
    EXPECT_NEAR(sum / kDraws, 3.0, 4 * std::sqrt(6.0 / kDraws)) << links;
  }
}

TEST(PlaneEvidence, TrustsMapPlanesWithoutAnEstimateByTheDefaults) {
  MapPlane one, other;
  one.pi_w = other.pi_w = {Eigen::Vector3d::UnitZ(), 0.0};
  one.centroid_w = {0.5, 0.2, 0.0};
  other.centroid_w = {0.1, -0.1, 0.0};  // half a metre away
  EXPECT_NEAR(ComparePlanes(one, other).offset_sigma_m,
              std::sqrt(2 * 0.003 * 0.003 + 0.01 * 0.01 * 0.25), 1e-12);
}

TEST(PlaneEvidence, ComparesMapPlanesAlikeHoweverTheWorldIsTurned) {
  const auto plane_of = [](const Pose& T, const Eigen::Vector3d& n, double height) {
    MapPlane m;
    const Eigen::Vector3d normal = n.normalized();
    // Seen at two places in a row: known well along the row, badly across.
    for (const double x : {-0.6, 0.6}) {
      const Eigen::Vector3d c(x, 0.3 * x, height);
      const Plane seen{T.R * normal, -(T.R * normal).dot(T * Eigen::Vector3d(0, 0, height))};
      AddObservation(m.estimate, seen, T * c, 0.05, 0.003, 1.0);
    }
    m.pi_w = m.estimate.Mean();
    m.centroid_w = ProjectOnto(m.pi_w, T * Eigen::Vector3d(0, 0, height));
    return m;
  };
  const auto chi2 = [&](const Pose& T) {
    return ComparePlanes(plane_of(T, {0.01, 0.03, 1}, 0.004), plane_of(T, {0, 0, 1}, 0)).chi2;
  };
  const double at_home = chi2({});
  EXPECT_GT(at_home, 0.1);
  for (const double turn : {0.3, 1.2, 2.0}) {
    EXPECT_NEAR(chi2({ExpSo3({0.5 * turn, -0.3, turn}), {1, 2, -1}}), at_home, 1e-6 * at_home);
  }
}

TEST(PlaneEvidence, OfTwoMapPlanesIsTheSameFromBothSides) {
  const auto seen_at = [](const Eigen::Vector3d& n, const Eigen::Vector3d& middle,
                          double sigma_m) {
    MapPlane m;
    const Plane pi{n.normalized(), -n.normalized().dot(middle)};
    for (const double x : {-0.3, 0.4}) {
      AddObservation(m.estimate, pi, ProjectOnto(pi, middle + Eigen::Vector3d(x, 0.5 * x, 0)),
                     0.02, sigma_m, 1.0);
    }
    m.pi_w = m.estimate.Mean();
    m.centroid_w = ProjectOnto(m.pi_w, middle);
    return m;
  };
  const MapPlane one = seen_at({0.004, -0.003, 1}, {0.2, 0.1, 0.003}, 0.002);
  const MapPlane other = seen_at({0, 0, 1}, {1.1, -0.7, 0}, 0.006);
  const double chi2 = ComparePlanes(one, other).chi2;
  EXPECT_GT(chi2, 0.1);
  EXPECT_NEAR(ComparePlanes(other, one).chi2, chi2, 1e-3 * chi2);
}

TEST(PlaneEvidence, OfAFramePlaneIsAlikeHoweverTheWorldIsTurned) {
  // Seen at two places in a row: known well along the row, badly across.
  const FramePlane f = PatchAt({0.3, 0.2, 1.5}, {0.05, 0.02, -1}, 1e-3, 1e-3);
  const auto chi2 = [&](const Pose& T_cw) {
    const Pose T_wc = Inverse(T_cw);
    const Plane pi_w = Transform(T_wc, Plane{Eigen::Vector3d(0, 0, -1), 1.505});
    MapPlane m;
    for (const double x : {-0.6, 0.6})
      AddObservation(m.estimate, pi_w, T_wc * Eigen::Vector3d(x, 0, 1.505), 0.05, 0.003, 1.0);
    m.pi_w = m.estimate.Mean();
    m.centroid_w = T_wc * Eigen::Vector3d(0, 0, 1.505);
    return ComparePlanes(f, m, {T_cw, Matrix6d::Zero()}, TinyFloors()).chi2;
  };
  const double at_home = chi2({});
  EXPECT_GT(at_home, 0.1);
  for (const double turn : {0.3, 1.2, 2.0}) {
    EXPECT_NEAR(chi2({ExpSo3({0.5 * turn, -0.3, turn}), {1, 2, -1}}), at_home, 1e-6 * at_home);
  }
}

constexpr double kPrior_m = 0.006, kMeasured_m = 0.004;

/// The camera, predicted `off_m` too far along the normal of the one plane that it sees.
UncertainPose CorrectedByOnePlane(double off_m, const AssociationConfig& config) {
  Map map;
  MapPlane m;
  m.pi_w = {Eigen::Vector3d(0, 0, -1), 2.0};
  AddLandmark(map, m);
  Frame frame;
  frame.planes = {PatchAt({0, 0, 2.0}, {0, 0, -1}, kMeasured_m, 0.01)};
  UncertainPose predicted;
  predicted.T_cw.t.z() = off_m;
  Vector6d variances = Vector6d::Constant(1e-14);
  variances[2] = kPrior_m * kPrior_m;
  predicted.covariance = variances.asDiagonal();
  return CorrectPrediction(predicted, frame, map, {{0, 0}}, config);
}

// Along its normal one plane and the prior are two measurements of one number.
TEST(CorrectedPrediction, WeighsItsPlaneAgainstThePriorByTheVariances) {
  constexpr double kOff_m = 0.005;
  const AssociationConfig config;
  const UncertainPose corrected = CorrectedByOnePlane(kOff_m, config);
  const double measured2 =
      kMeasured_m * kMeasured_m + config.offset_floor_m * config.offset_floor_m;
  const double prior2 = kPrior_m * kPrior_m;
  EXPECT_NEAR(corrected.T_cw.t.z(), kOff_m * measured2 / (prior2 + measured2), 1e-7);
  EXPECT_NEAR(corrected.covariance(2, 2), prior2 * measured2 / (prior2 + measured2), 1e-9);
}

TEST(CorrectedPrediction, IsPulledNoHarderThanTwoSigmasWhenItsPlaneIsFarOff) {
  constexpr double kOff_m = 0.05;
  const AssociationConfig config;
  const UncertainPose corrected = CorrectedByOnePlane(kOff_m, config);
  const double sigma_m = std::hypot(kMeasured_m, config.offset_floor_m);
  EXPECT_NEAR(corrected.T_cw.t.z(), kOff_m - 2 * kPrior_m * kPrior_m / sigma_m, 1e-4);
}

/// A pose by points, of a frame that sees planes 1 m and 3 m away.
Frame TrackedByPoints() {
  Frame frame;
  frame.T_cw = {ExpSo3({0.1, 0.2, -0.1}), {0.3, 0.1, -0.2}};
  frame.planes = {PatchAt({0.5, 0, 1.0}, {0, 0, -1}, 0.004, 0.01),
                  PatchAt({0, 0.4, 3.0}, {0, 0, -1}, 0.004, 0.01)};
  Matrix6d root = 1e-3 * Matrix6d::Identity();
  root(0, 4) = 7e-4, root(2, 3) = -4e-4;
  frame.pose_covariance = root * root.transpose();
  frame.evidence.of_pose = frame.pose_covariance->inverse();
  return frame;
}

TEST(PredictedPose, OfPointsErrsThreefoldAndByWhatTheSensorBends) {
  Frame frame = TrackedByPoints();
  EXPECT_LT((PredictedPose(frame).covariance - 9 * *frame.pose_covariance).norm(), 1e-15);
  frame.bend_ratio = 0.002;
  const UncertainPose bent = PredictedPose(frame);
  Matrix6d expected = 9 * *frame.pose_covariance;
  expected.diagonal().head<3>().array() += 0.004 * 0.004;  // two metres away
  expected.diagonal().tail<3>().array() += 0.002 * 0.002;
  EXPECT_LT((bent.covariance - expected).norm(), 1e-15);
  EXPECT_EQ(bent.T_cw.t, frame.T_cw.t);
  EXPECT_EQ(bent.T_cw.R, frame.T_cw.R);
}

TEST(PredictedPose, OfMotionAloneIsAsUncertainAsMotionSays) {
  Frame frame = TrackedByPoints();
  frame.bend_ratio = 0.002;
  frame.evidence = {};
  EXPECT_EQ(PredictedPose(frame).covariance, *frame.pose_covariance);
}

TEST(PredictedPose, WithoutACovarianceErrsByMillimetres) {
  Frame frame = TrackedByPoints();
  frame.bend_ratio = 0.002;
  frame.pose_covariance.reset();
  Matrix6d expected = Matrix6d::Zero();
  expected.diagonal() << 36e-6, 36e-6, 36e-6, 16e-6, 16e-6, 16e-6;
  EXPECT_LT((PredictedPose(frame).covariance - expected).norm(), 1e-15);
}

}  // namespace
}  // namespace slam
