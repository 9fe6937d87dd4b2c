#include "slam/pose/pose_problem.h"

#include <gtest/gtest.h>

#include <functional>

#include "slam/base/random.h"
#include "tests/support/plane_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kTruth{ExpSo3({0.3, -0.2, 0.1}), {0.4, -0.3, 0.2}};

/// Stereo features with `sigma_px` of noise; a share of them are wrong matches.
PoseProblem Seen(int points, double sigma_px, double wrong_share, std::uint64_t seed) {
  Random random{seed};
  const Camera camera;
  PoseProblem problem;
  for (int i = 0; i < points; ++i) {
    PointConstraint c;
    const Eigen::Vector2d u(random.Uniform() * 600 + 40, random.Uniform() * 440 + 20);
    const double z = 0.6 + 3 * random.Uniform();
    c.p_w = Inverse(kTruth) * camera.Backproject(u, z);
    const bool wrong = random.Uniform() < wrong_share;
    const auto noise = [&] {
      return wrong ? 80 * (random.Uniform() - 0.5) : sigma_px * Normal(random);
    };
    c.u_px = u + Eigen::Vector2d(noise(), noise());
    // As sure as a pixel of a stereo camera of 40 px m: at 2 m 0.1 m.
    c.depth_sigma_m = z * z / 40;
    c.depth_m = z / (1 + noise() * c.depth_sigma_m / z);
    problem.points.push_back(c);
  }
  problem.T_cw = Exp((Vector6d() << 0.02, -0.02, 0.02, 0.02, 0.03, -0.02).finished()) * kTruth;
  return problem;
}

TEST(PoseOptimiserEq13, FindsThePoseAmongWrongMatches) {
  const PoseSummary summary = OptimisePose(Seen(400, 1.0, 0.3, 1), Camera{}, {});
  EXPECT_TRUE(summary.usable);
  // One pixel over 280 points at 525 px and about two metres: 0.3 mm and 0.2 mrad; tenfold.
  EXPECT_THAT(summary.T_cw, PoseNear(kTruth, 2e-3, 3e-3));
  EXPECT_NEAR(summary.inlier_count, 0.95 * 0.7 * 400, 35);
}

/// Wrong matches that agree with each other pull the pose at first. What then seems wrong is asked
/// again from the pose without them: nineteen in twenty of the right ones are in the end.
TEST(PoseOptimiserEq13, AsksAgainWhatSeemedWrongAtFirst) {
  PoseProblem problem = Seen(1000, 1.0, 0.0, 2);
  const auto is_wrong = [](std::size_t i) { return i % 10 < 3; };
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    if (is_wrong(i)) problem.points[i].u_px.x() += 15;
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  int right = 0, found = 0;
  for (std::size_t i = 0; i < problem.points.size(); ++i) {
    if (is_wrong(i)) continue;
    ++right, found += summary.point_inliers[i] ? 1 : 0;
  }
  EXPECT_NEAR(found, 0.95 * right, 4 * std::sqrt(0.95 * 0.05 * right));
  EXPECT_EQ(summary.inlier_count, found);
}

TEST(PoseOptimiserEq13, IsConsistentWithItsInformation) {
  // 200 noisy runs: the squared error in units of the covariance is chi-square with 6 degrees
  // of freedom; five standard deviations of the mean are 5 sqrt(12 / 200). Points beyond the
  // 95 % bound t of 3 degrees of freedom are left out by their residual, which moves with the
  // pose: such an M-estimator scatters more than the points that it keeps promise, by
  // P(chi2_3 < t) / P(chi2_5 < t).
  constexpr double kScatter = 0.95 / 0.8333;
  constexpr int kRuns = 200;
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    const PoseSummary summary =
        OptimisePose(Seen(60, 1.0, 0.0, 100 + static_cast<std::uint64_t>(run)), Camera{}, {});
    const Vector6d error = Log(summary.T_cw * Inverse(kTruth));
    sum += error.dot(summary.evidence.of_pose * error);
  }
  EXPECT_NEAR(sum / kRuns, 6.0 * kScatter, 5 * std::sqrt(12.0 / kRuns));
}

TEST(PoseOptimiserEq13, RefusesAProblemThatConstrainsNothing) {
  PoseProblem problem;
  const PoseSummary nothing = OptimisePose(problem, Camera{}, {});
  EXPECT_FALSE(nothing.usable);
  EXPECT_EQ(nothing.nullity, 6);
  problem = Seen(2, 0.0, 0.0, 3);
  EXPECT_FALSE(OptimisePose(problem, Camera{}, {}).usable);  // free to turn about their line
}

TEST(PoseOptimiserEq13, LeavesTheOpenDirectionsOfASinglePlaneAlone) {
  PoseProblem problem;
  problem.T_cw = Pose{Eigen::Matrix3d::Identity(), {0.5, 0.5, 0}};
  PlaneConstraint c;
  c.pi_c = {-Eigen::Vector3d::UnitZ(), 1.0};
  c.pi_w = {-Eigen::Vector3d::UnitZ(), 1.02};
  c.centroid_c = {0, 0, 1};
  problem.planes.push_back(c);
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  EXPECT_EQ(summary.nullity, 3);
  EXPECT_FALSE(summary.usable);
  EXPECT_THAT(summary.T_cw,
              PoseNear((Pose{Eigen::Matrix3d::Identity(), {0.5, 0.5, -0.02}}), 1e-6, 1e-6));
}

/// A wall 1 m in front, seen 2 cm nearer than predicted.
PoseProblem WallNearerThanPredicted(double sigma_m) {
  PoseProblem problem;
  PlaneConstraint c;
  c.pi_c = {-Eigen::Vector3d::UnitZ(), 1.0};
  c.pi_w = {-Eigen::Vector3d::UnitZ(), 1.02};
  c.centroid_c = {0, 0, 1};
  c.angle_sigma_rad = c.offset_sigma_m = sigma_m;
  problem.planes.push_back(c);
  problem.prior.emplace();
  problem.prior->T_cw.t = {0.5, 0.4, 0};
  problem.prior->covariance.diagonal() << 4e-4, 9e-4, 1e-4, 1e-4, 2e-4, 16e-4;
  problem.T_cw = problem.prior->T_cw;
  return problem;
}

TEST(PoseOptimiserEq13, LeavesWhatNothingObservesWhereItWasPredictedAndAsUncertain) {
  PoseProblem problem = WallNearerThanPredicted(1e-5);
  problem.T_cw = Exp((Vector6d() << 0.02, -0.02, 0.02, 0, 0, 0.03).finished()) * problem.T_cw;
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  EXPECT_TRUE(summary.usable);
  EXPECT_EQ(summary.nullity, 0);
  EXPECT_THAT(summary.T_cw,
              PoseNear((Pose{Eigen::Matrix3d::Identity(), {0.5, 0.4, -0.02}}), 1e-5, 1e-5));
  const Matrix6d& predicted = problem.prior->covariance;
  for (const int i : {0, 1, 5}) {  // two steps along the wall, and the turn about its normal
    EXPECT_NEAR(summary.covariance(i, i), predicted(i, i), 1e-3 * predicted(i, i)) << i;
    EXPECT_NEAR(summary.evidence.of_pose(i, i), 0.0, 1e-3) << i;
  }
  for (const int i : {2, 3, 4})
    EXPECT_LT(summary.covariance(i, i), 1e-3 * predicted(i, i)) << i;
}

TEST(PoseOptimiserEq13, WeighsWhatIsMeasuredAgainstThePredictionByTheVariances) {
  const double measured_m = 0.02, predicted_m = 0.01;
  const PoseSummary summary = OptimisePose(WallNearerThanPredicted(measured_m), Camera{}, {});
  const double m2 = measured_m * measured_m, p2 = predicted_m * predicted_m;
  EXPECT_NEAR(summary.T_cw.t.z(), -0.02 * p2 / (p2 + m2), 1e-6);
  EXPECT_NEAR(summary.covariance(2, 2), p2 * m2 / (p2 + m2), 1e-9);
  EXPECT_NEAR(summary.evidence.of_pose(2, 2), 1 / m2, 1e-3 / m2);
}

// Two walls would have the camera d before and d behind its place: chi-square is 2 d^2 / sigma^2 of six
// degrees of freedom, so the variance of each is d^2 / 3, however sure it says it is.
TEST(PoseOptimiserEq13, TellsNoMoreThanPlanesThatDisagreeCanKnow) {
  constexpr double kSigma_m = 0.0005;
  const auto apart = [&](double d_m) {
    PoseProblem problem = WallNearerThanPredicted(kSigma_m);
    problem.planes.push_back(problem.planes.front());
    problem.planes[0].pi_w.d = 1.0 + d_m, problem.planes[1].pi_w.d = 1.0 - d_m;
    return OptimisePose(problem, Camera{}, {}).evidence.of_pose(2, 2);
  };
  const double alike = 2 / (kSigma_m * kSigma_m), wide = 6 / (0.01 * 0.01);
  EXPECT_NEAR(apart(0.5 * kSigma_m), alike, 1e-3 * alike);
  EXPECT_NEAR(apart(0.01), wide, 1e-3 * wide);
}

TEST(PoseOptimiserEq13, WithoutThePointFactorPlanesHoldThePoseAlone) {
  PoseProblem problem = Seen(100, 0.0, 0.0, 6);
  for (PointConstraint& point : problem.points) point.p_w.x() += 0.01;  // all say otherwise
  for (const Eigen::Vector3d& n_c :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, -1), Eigen::Vector3d(0, 1, -1)}) {
    PlaneConstraint c;
    c.pi_c = {n_c.normalized(), 2.0};
    c.centroid_c = -2.0 * c.pi_c.n;
    c.pi_w = Transform(Inverse(kTruth), c.pi_c);
    problem.planes.push_back(c);
  }
  PoseProblemConfig config;
  config.use_points = false;
  EXPECT_THAT(OptimisePose(problem, Camera{}, config).T_cw, PoseNear(kTruth, 1e-6, 1e-6));
}

TEST(PoseOptimiserEq13, APlaneAndTwoOfItsCornersHoldThePoseAlone) {
  PoseProblem problem = Seen(0, 0.0, 0.0, 7);
  PlaneConstraint plane;
  plane.pi_c = {Eigen::Vector3d(0.3, -0.2, -1).normalized(), 2.0};
  plane.centroid_c = -2.0 * plane.pi_c.n;
  plane.pi_w = Transform(Inverse(kTruth), plane.pi_c);
  problem.planes.push_back(plane);
  PoseProblemConfig config;
  config.use_vertices = true;
  for (const double along_m : {-0.2, 0.3}) {
    const Eigen::Vector3d p_c = plane.centroid_c + along_m * TangentBasis(plane.pi_c.n).col(0);
    problem.vertices.push_back(
        {Inverse(kTruth) * p_c, p_c, 300 * TangentBasis(plane.pi_c.n).transpose()});
    EXPECT_EQ(OptimisePose(problem, Camera{}, config).nullity, along_m < 0 ? 1 : 0);
  }
  EXPECT_THAT(OptimisePose(problem, Camera{}, config).T_cw, PoseNear(kTruth, 1e-6, 1e-6));
  config.use_vertices = false;
  EXPECT_EQ(OptimisePose(problem, Camera{}, config).nullity, 3);
}

/// One constraint of each kind that says otherwise than the points, and the same as no sensor tells it.
struct OtherFactor {
  const char* name;
  bool PoseProblemConfig::*use;  ///< null: it has no switch
  std::function<void(PoseProblem&)> add;
  std::vector<std::function<void(PoseProblem&)>> spoil;
};

std::vector<OtherFactor> OtherFactors() {
  using Problem = PoseProblem;
  const Pose T_wc = Inverse(kTruth);
  const Plane wall_c{Eigen::Vector3d(0, 0, -1), 2.0}, nearer_c{wall_c.n, 1.9};
  const Eigen::Vector3d on_wall_w = T_wc * Eigen::Vector3d(0, 0, 2);
  const Eigen::Matrix3d turn = ExpSo3({0.05, 0, 0});
  const double nan = std::nan("");
  return {
      {"plane",
       &PoseProblemConfig::use_planes,
       [=](Problem& p) {
         p.planes.emplace_back();
         p.planes[0].pi_c = nearer_c, p.planes[0].centroid_c = {0, 0, 1.9};
         p.planes[0].pi_w = Transform(T_wc, wall_c);
       },
       {[=](Problem& p) { p.planes[0].pi_w.d = nan; },
        [](Problem& p) { p.planes[0].pi_c.n *= 2; },
        [=](Problem& p) { p.planes[0].centroid_c.x() = nan; },
        [](Problem& p) { p.planes[0].angle_sigma_rad = 0; },
        [](Problem& p) { p.planes[0].offset_sigma_m = -1; }}},
      {"point on a plane",
       &PoseProblemConfig::use_point_planes,
       [=](Problem& p) {
         p.point_planes = {{on_wall_w, nearer_c, 0.01}};
       },
       {[](Problem& p) { p.point_planes[0].sigma_m = 0; },
        [=](Problem& p) { p.point_planes[0].p_w.y() = nan; },
        [](Problem& p) { p.point_planes[0].pi_c.n *= 2; }}},
      {"vertex",
       &PoseProblemConfig::use_vertices,
       [=](Problem& p) {
         p.vertices.emplace_back();
         p.vertices[0].p_w = on_wall_w, p.vertices[0].p_c = {0.05, 0, 2};
         p.vertices[0].sqrt_information.leftCols<2>() = 100 * Eigen::Matrix2d::Identity();
       },
       {[=](Problem& p) { p.vertices[0].p_w.x() = nan; },
        [=](Problem& p) { p.vertices[0].p_c.x() = nan; },
        [=](Problem& p) { p.vertices[0].sqrt_information(0, 0) = nan; }}},
      {"box",
       &PoseProblemConfig::use_boxes,
       [=](Problem& p) {
         BoxConstraint box;
         for (const double x : {-0.2, 0.2}) {
           for (const double y : {-0.2, 0.2}) {
             const Eigen::Vector3d corner_c(x, y, 2);
             box.corners_w.push_back(T_wc * corner_c);
             box.box_obs_px.Include(Camera{}.Project(corner_c) + Eigen::Vector2d(20, 0));
           }
         }
         p.boxes = {box};
       },
       {[=](Problem& p) { p.boxes[0].sigma_px = nan; },
        [](Problem& p) { p.boxes[0].box_obs_px = {}; },
        [=](Problem& p) { p.boxes[0].corners_w[2].z() = nan; }}},
      {"parallel",
       nullptr,
       [=](Problem& p) {
         p.parallels = {{kTruth.R.transpose() * wall_c.n, turn * wall_c.n, 0.01}};
       },
       {[](Problem& p) { p.parallels[0].n_c *= 2; },
        [](Problem& p) { p.parallels[0].n_w *= 2; },
        [](Problem& p) { p.parallels[0].sigma_rad = 0; }}},
      {"perpendicular",
       nullptr,
       [=](Problem& p) {
         const Eigen::Vector3d floor_c(0, -1, 0);
         p.perpendiculars = {{kTruth.R.transpose() * floor_c, turn * wall_c.n, 0.01}};
       },
       {[](Problem& p) { p.perpendiculars[0].sigma_rad = 0; }}},
      {"rotation",
       nullptr,
       [=](Problem& p) {
         p.rotations.emplace_back();
         p.rotations[0].R_cw = turn * kTruth.R;
         p.rotations[0].sqrt_information = 100 * Eigen::Matrix3d::Identity();
       },
       {[](Problem& p) { p.rotations[0].R_cw *= 1.1; },
        [=](Problem& p) { p.rotations[0].sqrt_information(0, 0) = nan; }}},
  };
}

TEST(PoseOptimiserEq13, WeighsEveryFactorThatIsOnAndNoneThatIsOffOrNoMeasurement) {
  const auto off = [](const PoseProblem& problem, const PoseProblemConfig& config) {
    const PoseSummary summary = OptimisePose(problem, Camera{}, config);
    EXPECT_TRUE(summary.usable);
    return Log(summary.T_cw * Inverse(kTruth)).norm();
  };
  for (const OtherFactor& other : OtherFactors()) {
    SCOPED_TRACE(other.name);
    PoseProblem problem = Seen(100, 0.0, 0.0, 9);
    other.add(problem);
    PoseProblemConfig config;
    if (other.use != nullptr) config.*other.use = true;
    EXPECT_GT(off(problem, config), 1e-6);
    for (std::size_t i = 0; i < other.spoil.size(); ++i) {
      PoseProblem spoilt = problem;
      other.spoil[i](spoilt);
      EXPECT_LT(off(spoilt, config), 1e-7) << i;
    }
    if (other.use == nullptr) continue;
    config.*other.use = false;
    EXPECT_LT(off(problem, config), 1e-7);
  }
}

// Of n walls one says D more than the others. By Huber's loss it pulls with its threshold, however large
// D is: the camera moves by threshold * sigma / (n - 1).
TEST(PoseOptimiserEq13, IsPulledByAPlaneThatContradictsOthersNoMoreThanHuberAllows) {
  constexpr int kOthers = 8;
  constexpr double kSigma_m = 0.002;
  for (const double threshold : {1.0, 2.0, 4.0}) {
    for (const double more_m : {0.05, 0.2}) {
      PoseProblem problem = WallNearerThanPredicted(kSigma_m);
      problem.prior->covariance *= 1e4;  // says nothing of the distance
      for (PlaneConstraint& c : problem.planes) c.pi_w.d = 1.0 + more_m;
      problem.planes.resize(1 + kOthers, problem.planes.front());
      for (std::size_t i = 1; i < problem.planes.size(); ++i) problem.planes[i].pi_w.d = 1.0;
      PoseProblemConfig config;
      config.huber_planes = threshold;
      config.iterations = 50;
      EXPECT_NEAR(OptimisePose(problem, Camera{}, config).T_cw.t.z(),
                  -threshold * kSigma_m / kOthers, 1e-6)
          << threshold << " " << more_m;
    }
  }
}

// From too far away a step by the slope overshoots, to where all points are behind the camera.
TEST(PoseOptimiserEq13, DoesNotPassThePointsToBeRidOfThem) {
  PoseProblem problem;
  for (int i = 0; i < 40; ++i) {
    const double around = 2 * M_PI * i / 40;
    PointConstraint c;
    c.p_w = {0.1 * std::cos(around), 0.08 * std::sin(around), 0.5};
    c.u_px = Camera{}.Project(c.p_w);
    problem.points.push_back(c);
  }
  problem.T_cw.t.z() = 0.9;
  PoseProblemConfig config;
  config.iterations = 40;
  const PoseSummary summary = OptimisePose(problem, Camera{}, config);
  EXPECT_EQ(summary.inlier_count, 40);
  EXPECT_THAT(summary.T_cw, PoseNear(Pose{}, 1e-6, 1e-6));
}

// A tenth of the points are 60 pixels off: their mean would be 6 pixels, Huber's is a third of one.
TEST(PoseOptimiserEq13, IsRobustInItsOnlyRound) {
  PoseProblem problem = Seen(400, 0.0, 0.0, 8);
  for (std::size_t i = 0; i < problem.points.size(); ++i)
    if (i % 10 == 0) problem.points[i].u_px.x() += 60;
  PoseProblemConfig config;
  config.rounds = 1;
  const Pose T_cw = OptimisePose(problem, Camera{}, config).T_cw;
  for (std::size_t i = 1; i < 10; ++i) {
    const PointConstraint& c = problem.points[i];
    EXPECT_LT((Camera{}.Project(T_cw * c.p_w) - c.u_px).norm(), 2.0) << i;
  }
}

TEST(PoseOptimiserEq13, RefusesAFirstGuessThatIsNotFinite) {
  PoseProblem problem = Seen(50, 0.0, 0.0, 4);
  problem.T_cw.t.x() = std::nan("");
  const PoseSummary summary = OptimisePose(problem, Camera{}, {});
  EXPECT_FALSE(summary.usable);
  EXPECT_EQ(summary.inlier_count, 0);
  EXPECT_EQ(summary.point_inliers.size(), 50u);
}

}  // namespace
}  // namespace slam
