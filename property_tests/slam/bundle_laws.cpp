#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/poses.h"
#include "slam/mapping/bundle/local_bundle.h"
#include "slam/mapping/bundle/plane_terms.h"
#include "slam/mapping/plane_motion.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/support/seen_outline.h"

namespace slam {
namespace {

/// Moves points, and all keyframes but the first, by up to so much, and planes as they are seen.
void Disturb(Map& map, double max_m, double max_rad) {
  for (Keyframe& keyframe : map.keyframes) {
    if (keyframe.id > 0) keyframe.T_cw = AnyMotion(max_rad, max_m) * keyframe.T_cw;
  }
  const int seed = AnyInt(0, 1 << 20);
  Random random{static_cast<std::uint64_t>(seed)};
  for (MapPoint& point : map.points) {
    for (int i = 0; i < 3; ++i) point.p_w[i] += max_m * (2 * random.Uniform() - 1);
  }
  PlaceAsSeen(map);
}

/// Without planes, with one, with parallel ones, with any; faces on which up to a half of the points
/// lie.
PointWorld AnyWorld() {
  PointWorld world =
      MakePointWorld(AnyInt(2, 5), AnyInt(80, 160),
                     static_cast<std::uint64_t>(AnyInt(0, 1 << 20)), AnyInt(1, 3));
  const int planes = AnyInt(0, 4);
  const bool parallel = AnyInt(0, 2) == 0;
  Eigen::Vector3d n = AnyUnit();
  for (int i = 0; i < planes; ++i) {
    const Eigen::Vector3d x_w(AnyReal(-1, 1), AnyReal(-1, 1), AnyReal(1, 3));
    AddSeenOutline(world.map, AddSeenLandmark(world.map, {n, -n.dot(x_w)}, x_w));
    if (!parallel) n = AnyUnit();
  }
  if (planes > 0) LayPointsOn(0, AnyInt(0, 40), world);
  return world;
}

/// Many iterations, and any of what may take part.
LocalBundleConfig AnyFactors() {
  LocalBundleConfig config;
  config.last_iterations = 30;
  config.use_point_planes = AnyInt(0, 1) == 1;
  config.use_coplanar_points = AnyInt(0, 1) == 1;
  config.use_edges = AnyInt(0, 1) == 1;
  config.use_vertices = AnyInt(0, 1) == 1;
  return config;
}

/// The planes are those of the other map, within these, where they were seen.
void AssertPlanesNear(const Map& map, const Map& expected, double rad, double m) {
  for (const MapPlane& plane : map.planes) {
    const MapPlane& other = expected.planes.At(plane.id);
    RC_ASSERT(Angle(plane.pi_w.n, other.pi_w.n) < rad);
    RC_ASSERT(std::abs(SignedDistance(plane.pi_w, other.centroid_w)) < m);
  }
}

RC_GTEST_PROP(LocalBundleLaws, FindsTheTrueMapAgainFromADisturbedOne, ()) {
  const PointWorld truth = AnyWorld();
  Map map = truth.map;
  Disturb(map, 0.004, 0.003);
  const LocalBundleConfig config = AnyFactors();
  const int newest = static_cast<int>(map.keyframes.size()) - 1;
  RC_ASSERT(AdjustLocalBundle(map, newest, truth.camera, FeatureScale{}, config).usable);
  for (const Keyframe& keyframe : map.keyframes) {
    const Pose& T_cw = truth.map.keyframes[static_cast<std::size_t>(keyframe.id)].T_cw;
    RC_ASSERT(RotationAngle(keyframe.T_cw, T_cw) < 1e-4);
    RC_ASSERT((keyframe.T_cw.t - T_cw.t).norm() < 1e-4);
  }
  AssertPlanesNear(map, truth.map, 1e-4, 1e-4);
}

// The estimate may depend on where the world's origin lies by no more than the solver's
// round-off.
RC_GTEST_PROP(LocalBundleLaws, MovesTheMapTheSameWayWhereverTheWorldOriginLies, ()) {
  const PointWorld truth = AnyWorld();
  Map here = truth.map;
  Disturb(here, 0.004, 0.003);
  Map there = here;
  const Pose T_vw = AnyPose(2), T_wv = Inverse(T_vw);
  for (Keyframe& keyframe : there.keyframes) keyframe.T_cw = keyframe.T_cw * T_wv;
  for (MapPoint& point : there.points) point.p_w = T_vw * point.p_w;
  for (MapPlane& plane : there.planes) MovePlane(plane, T_vw);
  const int newest = static_cast<int>(here.keyframes.size()) - 1;
  const LocalBundleConfig config = AnyFactors();
  AdjustLocalBundle(here, newest, truth.camera, FeatureScale{}, config);
  AdjustLocalBundle(there, newest, truth.camera, FeatureScale{}, config);
  for (std::size_t k = 0; k < here.keyframes.size(); ++k) {
    const Pose expected = here.keyframes[k].T_cw * T_wv;
    RC_ASSERT(RotationAngle(expected, there.keyframes[k].T_cw) < 1e-4);
    RC_ASSERT((expected.t - there.keyframes[k].T_cw.t).norm() < 3e-4);
  }
  for (MapPlane& plane : there.planes) MovePlane(plane, T_wv);
  AssertPlanesNear(there, here, 1e-4, 3e-4);
}

/// Every keyframe takes part; hardly an iteration, only the cost is asked for.
LocalBundleConfig CostOfAll() {
  LocalBundleConfig config;
  config.max_keyframes = 30;
  config.first_iterations = config.last_iterations = 1;
  return config;
}

double InitialCost(Map map, const Camera& camera) {
  const int newest = static_cast<int>(map.keyframes.size()) - 1;
  const auto report = AdjustLocalBundle(map, newest, camera, FeatureScale{}, CostOfAll());
  RC_ASSERT(report.usable);
  return report.initial_cost;
}

/// Two to twenty keyframes, without planes or with up to four.
PointWorld AnyLongWorld() {
  PointWorld world =
      MakePointWorld(AnyInt(2, 20), AnyInt(80, 160),
                     static_cast<std::uint64_t>(AnyInt(0, 1 << 20)), AnyInt(1, 3));
  for (int i = AnyInt(0, 4); i > 0; --i) {
    const Eigen::Vector3d n = AnyUnit(), x_w(AnyReal(-1, 1), AnyReal(-1, 1), AnyReal(1, 3));
    AddSeenLandmark(world.map, {n, -n.dot(x_w)}, x_w);
  }
  return world;
}

double ResidualsOf(const Map& map) {
  double residuals = 0;
  for (const MapPoint& point : map.points)
    residuals += 3 * static_cast<double>(point.observations.size());
  for (const Keyframe& keyframe : map.keyframes)
    residuals += 4 * static_cast<double>(keyframe.planes.size());
  return residuals;
}

// Pixels of 1e-13, and metres of 1e-15 in sigmas of some millimetres.
RC_GTEST_PROP(LocalBundleLaws, CostsNothingAtTheTruth, ()) {
  const PointWorld truth = AnyLongWorld();
  RC_ASSERT(InitialCost(truth.map, truth.camera) <= 1e-20 * ResidualsOf(truth.map));
}

RC_GTEST_PROP(LocalBundleLaws, CostsTheSameWhereverTheWorldOriginLies, ()) {
  const PointWorld truth = AnyWorld();
  Map here = truth.map;
  Disturb(here, 0.01, 0.005);
  Map there = here;
  const Pose T_vw = AnyPose(2), T_wv = Inverse(T_vw);
  for (Keyframe& keyframe : there.keyframes) keyframe.T_cw = keyframe.T_cw * T_wv;
  for (MapPoint& point : there.points) point.p_w = T_vw * point.p_w;
  for (MapPlane& plane : there.planes) MovePlane(plane, T_vw);
  const double cost = InitialCost(here, truth.camera);
  RC_ASSERT(cost > 1.0);
  RC_ASSERT(std::abs(InitialCost(there, truth.camera) - cost) < 1e-10 * cost);
}

/// Where the map comes back to; a hundred starts, and none may miss.
void AssertComesBack(const PointWorld& truth, double rad, double m) {
  Map map = truth.map;
  Disturb(map, 0.05, 0.087);
  LocalBundleConfig config;
  config.first_iterations = 20;
  config.last_iterations = 30;
  const int newest = static_cast<int>(map.keyframes.size()) - 1;
  RC_ASSERT(AdjustLocalBundle(map, newest, truth.camera, FeatureScale{}, config).usable);
  for (const Keyframe& keyframe : map.keyframes) {
    const Pose& T_cw = truth.map.keyframes[static_cast<std::size_t>(keyframe.id)].T_cw;
    RC_ASSERT(RotationAngle(keyframe.T_cw, T_cw) < rad);
    RC_ASSERT((keyframe.T_cw.t - T_cw.t).norm() < m);
  }
}

RC_GTEST_PROP(LocalBundleLaws, FindsThePosesFromFiveDegreesAndFiveCentimetres, ()) {
  AssertComesBack(MakePointWorld(AnyInt(2, 5), AnyInt(80, 160),
                                 static_cast<std::uint64_t>(AnyInt(0, 1 << 20)), AnyInt(1, 3)),
                  1e-8, 1e-8);
}

// What holds the poses where planes leave them free (StayTerm) pulls towards where they were: up to
// 6.2e-5 and 0.15 mm in 1,200 starts.
RC_GTEST_PROP(LocalBundleLaws, FindsThePosesFromFarOffWithPlanesToo, ()) {
  AssertComesBack(AnyWorld(), 1.9e-4, 4.5e-4);
}

/// Five-point derivative along the three steps of the plane's manifold.
template <int kRows, typename Residual>
Eigen::Matrix<double, kRows, 3> ByPlaneStep(const PlaneBlock& block, const Residual& residual) {
  constexpr double h = 1e-3;
  const PlaneManifold manifold;
  Eigen::Matrix<double, kRows, 3> J;
  for (int i = 0; i < 3; ++i) {
    const auto at = [&](double step) -> Eigen::Matrix<double, kRows, 1> {
      const Eigen::Vector3d delta = step * Eigen::Vector3d::Unit(i);
      PlaneBlock moved;
      manifold.Plus(block.data(), delta.data(), moved.data());
      return residual(moved);
    };
    J.col(i) = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
  }
  return J;
}

RC_GTEST_PROP(PlaneTermEq16, HasItsJacobiansAtEveryOrientation, ()) {
  Keyframe keyframe;
  keyframe.T_cw = AnyPose(3);
  const Eigen::Vector3d n = AnyUnit(), x_w = AnyPoint(3);
  KeyframePlane seen = ExactKeyframePlane(keyframe, 0, {n, -n.dot(x_w)}, x_w);
  seen.angle_sigma_rad = seen.offset_sigma_m = 1.0;
  const Eigen::Vector3d reference_w = x_w + AnyPoint(0.5);
  const PlaneTerm term(seen, reference_w);
  const Pose T_cw = AnyMotion(0.5, 0.3) * keyframe.T_cw;
  const Eigen::Vector3d turned = ExpSo3(0.3 * AnyPoint(1)) * n;
  const PlaneBlock plane = BlockOf({turned, -turned.dot(x_w) + 0.1}, reference_w);
  const auto residual = [&](const Pose& at, const PlaneBlock& block) {
    const PoseBlock pose = BlockOf(at);
    const double* parameters[] = {pose.data(), block.data()};
    Eigen::Vector4d r;
    term.Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  const PoseBlock pose = BlockOf(T_cw);
  Eigen::Matrix<double, 4, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> by_plane;
  Eigen::Matrix<double, 4, 3, Eigen::RowMajor> by_step;
  double* jacobians[] = {by_pose.data(), by_plane.data()};
  const double* parameters[] = {pose.data(), plane.data()};
  Eigen::Vector4d r;
  term.Evaluate(parameters, r.data(), jacobians);
  PlaneManifold().PlusJacobian(plane.data(), by_step.data());
  constexpr double kTolerance = 1e-6;  // the five-point difference reaches 1e-9
  RC_ASSERT(JacobianError(by_pose.leftCols<6>(), NumericJacobian<4>(T_cw, [&](const Pose& T) {
                            return residual(T, plane);
                          })) < kTolerance);
  RC_ASSERT(JacobianError(by_plane * by_step, ByPlaneStep<4>(plane, [&](const PlaneBlock& x) {
                            return residual(T_cw, x);
                          })) < kTolerance);
}

RC_GTEST_PROP(PlaneManifoldLaws, StepsForthAndBackFromEveryPoleToTheLastDigits, ()) {
  const PlaneManifold manifold;
  const Eigen::Vector3d n = AnyUnit();
  const PlaneBlock x{n.x(), n.y(), n.z(), AnyInt(0, 4) == 0 ? 0.0 : AnyReal(-10, 10)};
  const double a = AnyReal(-M_PI, M_PI);
  const double turn = AnyInt(0, 2) == 0 ? std::pow(10.0, AnyReal(-12, 0)) : AnyReal(0, 3.0);
  const Eigen::Vector3d delta(turn * std::cos(a), turn * std::sin(a), AnyReal(-1, 1));
  PlaneBlock y, y_again;
  Eigen::Vector3d back;
  RC_ASSERT(manifold.Plus(x.data(), delta.data(), y.data()));
  RC_ASSERT(manifold.Minus(y.data(), x.data(), back.data()));
  RC_ASSERT(manifold.Plus(x.data(), back.data(), y_again.data()));
  const Eigen::Map<const Eigen::Vector4d> one(y.data()), two(y_again.data());
  RC_ASSERT(std::abs(one.head<3>().norm() - 1) < 1e-13);
  // As far as it was told to, whatever the pole, and back by the same step.
  RC_ASSERT(std::abs(Angle(one.head<3>().normalized(), n) - turn) < 1e-13);
  RC_ASSERT((back - delta).norm() < 1e-13 + 1e-15 * std::abs(x[3]));
  RC_ASSERT((one - two).norm() < 1e-13 + 1e-15 * std::abs(x[3]));
}

}  // namespace
}  // namespace slam
