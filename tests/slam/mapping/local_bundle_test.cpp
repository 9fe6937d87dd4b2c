#include "slam/mapping/bundle/local_bundle.h"

#include <gmock/gmock.h>

#include "slam/mapping/bundle/bundle_terms.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/point_world.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

Vector6d AnyStep(Random& random, double half_m, double half_rad) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = (2 * random.Uniform() - 1) * (i < 3 ? half_m : half_rad);
  return xi;
}

/// Moves all points, and all keyframes but the first, by a little.
void Disturb(Map& map, double half_m, double half_rad) {
  Random random{11};
  for (Keyframe& keyframe : map.keyframes) {
    if (keyframe.id > 0) {
      keyframe.T_cw = Exp(AnyStep(random, half_m, half_rad)) * keyframe.T_cw;
    }
  }
  for (MapPoint& point : map.points) {
    point.p_w += AnyStep(random, half_m, 0).head<3>();
  }
}

void ExpectPosesNear(const Map& map, const Map& truth, double rad, double m) {
  for (const Keyframe& keyframe : map.keyframes) {
    EXPECT_THAT(keyframe.T_cw,
                PoseNear(truth.keyframes[static_cast<std::size_t>(keyframe.id)].T_cw, rad, m));
  }
}

TEST(LocalBundle, FindsTheTrueMapAgainFromADisturbedOne) {
  const PointWorld truth = MakePointWorld(5, 200, 1);
  Map map = truth.map;
  Disturb(map, 0.005, 0.003);
  LocalBundleConfig config;
  config.last_iterations = 20;
  const LocalBundleReport report =
      AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, config);
  EXPECT_TRUE(report.usable);
  EXPECT_EQ(report.outliers, 0);
  EXPECT_EQ(report.keyframes, 4);
  EXPECT_EQ(report.fixed_keyframes, 1);
  // Exact observations: what remains is the solver's tolerance.
  ExpectPosesNear(map, truth.map, 1e-5, 1e-5);
  for (const MapPoint& point : map.points) {
    EXPECT_THAT(point.p_w,
                VectorNear(truth.map.points[static_cast<std::size_t>(point.id)].p_w, 1e-4));
  }
}

TEST(LocalBundle, FindsItWithoutDepthWhenTwoFixedKeyframesGiveTheScale) {
  const PointWorld truth = MakePointWorld(5, 200, 2, 1000);
  Map map = truth.map;
  Disturb(map, 0.002, 0.001);
  for (std::size_t k = 0; k < 4; ++k) map.keyframes[k].T_cw = truth.map.keyframes[k].T_cw;
  LocalBundleConfig config;
  config.max_keyframes = 3;  // two keyframes are left to hold position and scale
  config.last_iterations = 30;
  const LocalBundleReport report =
      AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, config);
  EXPECT_TRUE(report.usable);
  EXPECT_EQ(report.keyframes, 3);
  EXPECT_EQ(report.fixed_keyframes, 2);
}

TEST(LocalBundle, TakesFalseObservationsBackAndIsNotBentByThem) {
  const PointWorld truth = MakePointWorld(5, 200, 3);
  Map map = truth.map;
  for (int k = 1; k < 5; ++k) {
    for (const int f : {3 + 10 * k, 50 + 10 * k, 100 + 10 * k}) {  // each of another point
      map.keyframes[static_cast<std::size_t>(k)].features[static_cast<std::size_t>(f)].u_px +=
          Eigen::Vector2d(25, -18);
    }
  }
  Disturb(map, 0.003, 0.002);
  LocalBundleConfig config;
  config.last_iterations = 20;
  const LocalBundleReport report =
      AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, config);
  EXPECT_TRUE(report.usable);
  EXPECT_GE(report.outliers, 12);
  EXPECT_LE(report.outliers, 16);
  ExpectPosesNear(map, truth.map, 1e-4, 1e-4);
}

TEST(LocalBundle, TakesBackWhatFitsAgainOnceThePosesAreRight) {
  const PointWorld truth = MakePointWorld(5, 200, 1);
  Map map = truth.map;
  Disturb(map, 0.06, 0.03);
  LocalBundleConfig config;
  config.first_iterations = 1;  // too few: some of what is right does not fit yet
  config.last_iterations = 30;
  const LocalBundleReport report =
      AdjustLocalBundle(map, 4, truth.camera, FeatureScale{}, config);
  EXPECT_TRUE(report.usable);
  EXPECT_EQ(report.outliers, 0);
}

TEST(LocalBundle, LeavesFixedKeyframesWhereTheyAre) {
  const PointWorld truth = MakePointWorld(6, 200, 4);
  Map map = truth.map;
  Disturb(map, 0.003, 0.002);
  const Map before = map;
  LocalBundleConfig config;
  config.max_keyframes = 2;
  AdjustLocalBundle(map, 5, truth.camera, FeatureScale{}, config);
  int moved = 0;
  for (std::size_t k = 0; k < map.keyframes.size(); ++k) {
    moved += map.keyframes[k].T_cw.t != before.keyframes[k].T_cw.t;
  }
  EXPECT_EQ(moved, 2);
  EXPECT_EQ(map.keyframes[0].T_cw.t, before.keyframes[0].T_cw.t);
}

/// A disturbed map of which planes hold keyframe 3.
Map HeldByPlanesAt3(const PointWorld& truth) {
  Map map = truth.map;
  map.keyframes[3].by_points = false;
  Disturb(map, 0.003, 0.002);
  return map;
}

TEST(LocalBundle, LeavesAKeyframeThatPlanesHoldWhereItIs) {
  const PointWorld truth = MakePointWorld(6, 200, 4);
  Map map = HeldByPlanesAt3(truth);
  const Map before = map;
  const LocalBundleReport report = AdjustLocalBundle(map, 5, truth.camera, FeatureScale{}, {});
  EXPECT_TRUE(report.usable);
  EXPECT_EQ(report.keyframes, 4);  // 1, 2, 4 and 5
  EXPECT_EQ(report.fixed_keyframes, 2);
  for (const std::size_t k : {1u, 2u, 4u, 5u})
    EXPECT_NE(map.keyframes[k].T_cw.t, before.keyframes[k].T_cw.t) << k;
  EXPECT_EQ(map.keyframes[3].T_cw.t, before.keyframes[3].T_cw.t);
  EXPECT_EQ(map.keyframes[3].T_cw.R, before.keyframes[3].T_cw.R);
}

TEST(LocalBundle, DoesNothingWhereOnlyAKeyframeOfPlanesWouldMove) {
  const PointWorld truth = MakePointWorld(6, 200, 4);
  Map map = HeldByPlanesAt3(truth);
  const Map before = map;
  LocalBundleConfig config;
  config.max_keyframes = 1;
  EXPECT_FALSE(AdjustLocalBundle(map, 3, truth.camera, FeatureScale{}, config).usable);
  for (std::size_t k = 0; k < map.keyframes.size(); ++k)
    EXPECT_EQ(map.keyframes[k].T_cw.t, before.keyframes[k].T_cw.t) << k;
}

TEST(LocalBundle, GivesTheSameBytesTwice) {
  const PointWorld truth = MakePointWorld(5, 150, 5);
  Map first = truth.map;
  Disturb(first, 0.005, 0.003);
  Map second = first;
  AdjustLocalBundle(first, 4, truth.camera, FeatureScale{}, {});
  ASSERT_NE(first.keyframes[4].T_cw.t, second.keyframes[4].T_cw.t) << "nothing has moved";
  AdjustLocalBundle(second, 4, truth.camera, FeatureScale{}, {});
  for (std::size_t k = 0; k < first.keyframes.size(); ++k) {
    EXPECT_EQ(first.keyframes[k].T_cw.R, second.keyframes[k].T_cw.R);
    EXPECT_EQ(first.keyframes[k].T_cw.t, second.keyframes[k].T_cw.t);
  }
  for (std::size_t i = 0; i < first.points.size(); ++i) {
    EXPECT_EQ(first.points[i].p_w, second.points[i].p_w);
  }
}

TEST(LocalBundle, DropsAPointBehindItsCamera) {
  PointWorld world = MakePointWorld(4, 150, 6);
  const int behind = PointAt(world.map, 3, 0);
  world.map.points[static_cast<std::size_t>(behind)].p_w = {0, 0, -3};
  const LocalBundleReport report =
      AdjustLocalBundle(world.map, 3, world.camera, FeatureScale{}, {});
  EXPECT_TRUE(report.usable);
  EXPECT_TRUE(world.map.points[static_cast<std::size_t>(behind)].culled);
}

TEST(LocalBundle, DoesNothingForTheFirstKeyframeAlone) {
  PointWorld world = MakePointWorld(1, 50, 7);
  EXPECT_FALSE(AdjustLocalBundle(world.map, 0, world.camera, FeatureScale{}, {}).usable);
}

// Else the adjustment could make an error vanish by putting its point behind the camera.
TEST(BundleTerm, IsFarFromAnyObservationWhereThePointIsBehindTheCamera) {
  const Camera camera;
  const BundleTerm term({{0, 0, 2}, {camera.cx, camera.cy}, 1.0, 2.0, 0.01}, camera);
  const PoseBlock here = BlockOf(Pose{});
  for (const auto& [z_m, behind] : {std::pair(2.0, false), {-2.0, true}, {0.0, true}}) {
    const Eigen::Vector3d p_w(0, 0, z_m);
    const double* blocks[] = {here.data(), p_w.data()};
    Eigen::Vector3d residual;
    ASSERT_TRUE(term.Evaluate(blocks, residual.data(), nullptr));
    EXPECT_EQ(residual.norm() >= BundleTerm::kBehind, behind) << z_m;
  }
}

TEST(BundleTerm, HasTheDerivativesOfItsDifferenceQuotients) {
  const Camera camera;
  const Eigen::Vector3d p_w(0.2, -0.1, 1.6);
  const Pose T_cw{ExpSo3({0.1, 0.2, -0.1}), {0.1, 0, 0.2}};
  PointFeature feature = FeatureOfPoint(p_w, T_cw, camera, {}, true);
  feature.u_px += Eigen::Vector2d(3, -5);
  const BundleTerm term({p_w, feature.u_px, 1.44, feature.depth_m, 0.01}, camera);
  const PoseManifold manifold;
  const PoseBlock block = BlockOf(T_cw);
  const auto residual = [&](const Vector6d& xi, const Eigen::Vector3d& dp) {
    PoseBlock moved;
    manifold.Plus(block.data(), xi.data(), moved.data());
    const Eigen::Vector3d p = p_w + dp;
    const double* parameters[] = {moved.data(), p.data()};
    Eigen::Vector3d r;
    term.Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  Eigen::Matrix<double, 3, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor> by_point;
  double* jacobians[] = {by_pose.data(), by_point.data()};
  const double* parameters[] = {block.data(), p_w.data()};
  Eigen::Vector3d r;
  term.Evaluate(parameters, r.data(), jacobians);
  constexpr double kStep = 1e-6;
  constexpr double kTolerance = 1e-4;  // derivatives up to 1e3, second ones times the step
  for (int i = 0; i < 6; ++i) {
    const Vector6d xi = kStep * Vector6d::Unit(i);
    const Eigen::Vector3d slope =
        (residual(xi, Eigen::Vector3d::Zero()) - residual(-xi, Eigen::Vector3d::Zero())) /
        (2 * kStep);
    EXPECT_LT((by_pose.col(i) - slope).norm(), kTolerance) << "coordinate " << i;
  }
  EXPECT_EQ(by_pose.col(6).norm(), 0.0);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d dp = kStep * Eigen::Vector3d::Unit(i);
    const Eigen::Vector3d slope =
        (residual(Vector6d::Zero(), dp) - residual(Vector6d::Zero(), -dp)) / (2 * kStep);
    EXPECT_LT((by_point.col(i) - slope).norm(), kTolerance) << "coordinate " << i;
  }
}

TEST(PoseManifold, StepsForthAndBack) {
  const PoseManifold manifold;
  const PoseBlock x = BlockOf({ExpSo3({0.4, -0.7, 1.1}), {1, -2, 3}});
  Vector6d xi;
  xi << 0.1, -0.2, 0.3, 0.4, -0.1, 0.2;
  PoseBlock y;
  Vector6d back;
  manifold.Plus(x.data(), xi.data(), y.data());
  manifold.Minus(y.data(), x.data(), back.data());
  EXPECT_LT((back - xi).norm(), 1e-12);
}

TEST(StayTerm, CountsSigmasFromWhereThePoseWasAndHasItsDerivatives) {
  const Pose before{ExpSo3({0.4, -0.7, 1.1}), {1, -2, 3}};
  Vector6d step;
  step << 0.1, 0, 0, 0, 0, 0;
  const StayTerm term(before);
  const auto residual = [&](const Pose& T_cw) {
    const PoseBlock block = BlockOf(T_cw);
    const double* parameters[] = {block.data()};
    Vector6d r;
    term.Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  EXPECT_NEAR(residual(Exp(step) * before).norm(), 0.1 / StayTerm::kSigma_m, 1e-9);
  step << 0.02, -0.01, 0.03, 0.02, 0.01, -0.04;
  const Pose moved = Exp(step) * before;
  const PoseBlock block = BlockOf(moved);
  const double* parameters[] = {block.data()};
  Vector6d r;
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> J;
  double* jacobians[] = {J.data()};
  term.Evaluate(parameters, r.data(), jacobians);
  EXPECT_LT(JacobianError(J.leftCols<6>(), NumericJacobian<6>(moved, residual)), 1e-6);
}

}  // namespace
}  // namespace slam
