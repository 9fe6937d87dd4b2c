#include "slam/mapping/bundle/plane_terms.h"

#include <ceres/manifold_test_utils.h>
#include <gmock/gmock.h>

#include <cmath>

#include "slam/base/random.h"
#include "tests/support/block_derivatives.h"
#include "tests/support/normal_draws.h"
#include "tests/support/seen_landmark.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kT_cw{ExpSo3({0.1, 0.2, -0.1}), {0.1, 0, 0.2}};
const Eigen::Vector3d kReference_w(0.3, -0.2, 1.9);
const Plane kPlane_w{Eigen::Vector3d(0.2, 0.3, -0.9).normalized(), 1.9};

/// A measurement that is off by a turn and an offset.
KeyframePlane Measured() {
  Keyframe keyframe;
  keyframe.T_cw = Pose{ExpSo3({0.05, -0.1, 0.07}), {0.02, 0.03, -0.01}} * kT_cw;
  KeyframePlane seen = ExactKeyframePlane(keyframe, 0, kPlane_w, {0.7, 0.1, 2});
  seen.angle_sigma_rad = 0.02, seen.offset_sigma_m = 0.004;
  return seen;
}

/// An estimate of a plane near the test's.
PlaneEstimate KnownBesides() {
  PlaneEstimate estimate;
  for (const double shift : {-0.3, 0.1, 0.4}) {
    Plane seen = kPlane_w;
    seen.n = ExpSo3({0.02 + 0.1 * shift, -0.05, 0.03}) * seen.n;
    AddObservation(estimate, seen, kReference_w + Eigen::Vector3d(shift, 0.2, 0), 0.01, 0.003,
                   1.0);
  }
  return estimate;
}

TEST(PlaneTerm, IsZeroAtTheTruthAndCountsSigmas) {
  Keyframe keyframe;
  keyframe.T_cw = kT_cw;
  KeyframePlane seen = ExactKeyframePlane(keyframe, 0, kPlane_w, {0.7, 0.1, 2});
  seen.angle_sigma_rad = 0.02, seen.offset_sigma_m = 0.004;
  const PoseBlock pose = BlockOf(kT_cw);
  Plane off = kPlane_w;
  const auto residual = [&] {
    const PlaneBlock block = BlockOf(off, kReference_w);
    const double* parameters[] = {pose.data(), block.data()};
    Eigen::Vector4d r;
    PlaneTerm(seen, kReference_w).Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  EXPECT_LT(residual().norm(), 1e-9);
  off.d += 0.008;
  EXPECT_NEAR(residual()[3], 2.0, 1e-9);
  off.n = ExpSo3(0.06 * TangentBasis(off.n).col(0)) * off.n;
  EXPECT_NEAR(residual().head<3>().norm(), 3.0, 1e-9);
}

TEST(PlaneTerm, HasTheDerivativesOfItsDifferenceQuotients) {
  const PlaneTerm term(Measured(), kReference_w);
  const PoseBlock pose = BlockOf(kT_cw);
  const PlaneBlock plane = BlockOf(kPlane_w, kReference_w);
  const auto residual = [&](const double* at_pose, const double* at_plane) {
    const double* parameters[] = {at_pose, at_plane};
    Eigen::Vector4d r;
    term.Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  Eigen::Matrix<double, 4, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> by_plane;
  double* jacobians[] = {by_pose.data(), by_plane.data()};
  const double* parameters[] = {pose.data(), plane.data()};
  Eigen::Vector4d r;
  term.Evaluate(parameters, r.data(), jacobians);
  EXPECT_GT(r.norm(), 1.0);
  ExpectDerivatives<4, 7, 6>(pose.data(), PoseManifold(), by_pose,
                             [&](const double* x) { return residual(x, plane.data()); });
  ExpectDerivatives<4, 4, 3>(plane.data(), PlaneManifold(), by_plane,
                             [&](const double* x) { return residual(pose.data(), x); });
}

TEST(PlaneTerm, RefusesAPlaneFaceToFaceWithTheMeasuredOne) {
  Keyframe keyframe;
  keyframe.T_cw = kT_cw;
  const PlaneTerm term(ExactKeyframePlane(keyframe, 0, kPlane_w, kReference_w), kReference_w);
  const PoseBlock pose = BlockOf(kT_cw);
  const PlaneBlock back = BlockOf({-kPlane_w.n, -kPlane_w.d}, kReference_w);
  Eigen::Matrix<double, 4, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> by_plane;
  double* jacobians[] = {by_pose.data(), by_plane.data()};
  const double* parameters[] = {pose.data(), back.data()};
  Eigen::Vector4d r;
  EXPECT_TRUE(term.Evaluate(parameters, r.data(), jacobians));
  EXPECT_EQ(r[0], PlaneTerm::kRefused);
  EXPECT_EQ(by_pose.norm() + by_plane.norm(), 0.0);
}

TEST(PlanePriorTerm, IsZeroAtItsMeanAndHasTheDerivativesOfItsDifferenceQuotients) {
  const PlaneEstimate estimate = KnownBesides();
  const PlanePriorTerm term(estimate, kReference_w);
  const auto residual = [&](const double* x) {
    Eigen::Vector3d r;
    EXPECT_TRUE(term.Evaluate(&x, r.data(), nullptr));
    return r;
  };
  EXPECT_LT(residual(BlockOf(estimate.Mean(), kReference_w).data()).norm(), 1e-9);
  const PlaneBlock plane = BlockOf(kPlane_w, kReference_w);
  const double* parameters[] = {plane.data()};
  Eigen::Matrix<double, 3, 4, Eigen::RowMajor> by_plane;
  double* jacobians[] = {by_plane.data()};
  Eigen::Vector3d r;
  term.Evaluate(parameters, r.data(), jacobians);
  EXPECT_GT(r.norm(), 1.0);
  ExpectDerivatives<3, 4, 3>(plane.data(), PlaneManifold(), by_plane, residual);
}

TEST(PlanePriorTerm, CountsSigmasWhereAndAsThePlaneWasSeen) {
  PlaneEstimate estimate;
  AddObservation(estimate, kPlane_w, kReference_w, 0.01, 0.003, 1.0);
  Plane off = kPlane_w;
  off.d += 0.006;
  const PlaneBlock block = BlockOf(off, kReference_w);
  const double* parameters[] = {block.data()};
  Eigen::Vector3d r;
  PlanePriorTerm(estimate, kReference_w).Evaluate(parameters, r.data(), nullptr);
  EXPECT_NEAR(r.norm(), 2.0, 1e-9);
}

TEST(PlanePriorTerm, CountsTheSigmasOfAllPlacesWhereThePlaneWasSeen) {
  PlaneEstimate estimate;
  const Plane desk_w{Eigen::Vector3d::UnitZ(), 0.0};
  constexpr double kLoose_rad = 1e3;
  AddObservation(estimate, desk_w, {0, 0, 0}, kLoose_rad, 0.003, 1.0);
  AddObservation(estimate, desk_w, {0.6, 0.8, 0}, kLoose_rad, 0.004, 1.0);
  // Two sigmas too high at the first place, three at the second, a metre from it.
  const double slope = 3 * 0.004 - 2 * 0.003;
  const Eigen::Vector3d n = Eigen::Vector3d(-0.6 * slope, -0.8 * slope, 1).normalized();
  const PlaneBlock block = BlockOf({n, -n.z() * 0.006}, kReference_w);
  const double* parameters[] = {block.data()};
  Eigen::Vector3d r;
  PlanePriorTerm(estimate, kReference_w).Evaluate(parameters, r.data(), nullptr);
  EXPECT_NEAR(r.squaredNorm(), 4 + 9, 1e-6);
}

TEST(PlanePriorTerm, SaysNothingOfAPlaneTurnedBySixtyDegrees) {
  PlaneEstimate estimate;
  AddObservation(estimate, kPlane_w, kReference_w, 0.01, 0.003, 1.0);
  const PlanePriorTerm term(estimate, kReference_w);
  const auto can_say = [&](double turn_rad) {
    Plane turned = kPlane_w;
    turned.n = ExpSo3(turn_rad * TangentBasis(kPlane_w.n).col(0)) * kPlane_w.n;
    const PlaneBlock block = BlockOf(turned, kReference_w);
    const double* parameters[] = {block.data()};
    Eigen::Vector3d r;
    return term.Evaluate(parameters, r.data(), nullptr);
  };
  EXPECT_TRUE(can_say(0.98 * M_PI / 3));
  EXPECT_FALSE(can_say(1.02 * M_PI / 3));
  EXPECT_FALSE(can_say(M_PI));
}

TEST(PlanePriorTerm, GivesNoDerivativesByABlockThatIsHeld) {
  const PlanePriorTerm term(KnownBesides(), kReference_w);
  const PlaneBlock block = BlockOf(kPlane_w, kReference_w);
  const double* parameters[] = {block.data()};
  double* jacobians[] = {nullptr};  // so Ceres asks for it
  Eigen::Vector3d r, alone;
  EXPECT_TRUE(term.Evaluate(parameters, r.data(), jacobians));
  EXPECT_TRUE(term.Evaluate(parameters, alone.data(), nullptr));
  EXPECT_EQ(r, alone);
}

TEST(PointOnPlaneTerm, CountsSigmasAndHasTheDerivativesOfItsDifferenceQuotients) {
  const PointOnPlaneTerm term(0.005, kReference_w);
  const Eigen::Vector3d p_w = ProjectOnto(kPlane_w, {0.6, 0.4, 1.7}) + 0.01 * kPlane_w.n;
  const PlaneBlock plane = BlockOf(kPlane_w, kReference_w);
  const auto residual = [&](const double* at_point, const double* at_plane) {
    const double* parameters[] = {at_point, at_plane};
    Eigen::Matrix<double, 1, 1> r;
    term.Evaluate(parameters, r.data(), nullptr);
    return r;
  };
  EXPECT_NEAR(residual(p_w.data(), plane.data())[0], 2.0, 1e-9);
  Eigen::Matrix<double, 1, 3, Eigen::RowMajor> by_point;
  Eigen::Matrix<double, 1, 4, Eigen::RowMajor> by_plane;
  double* jacobians[] = {by_point.data(), by_plane.data()};
  const double* parameters[] = {p_w.data(), plane.data()};
  double r = 0;
  term.Evaluate(parameters, &r, jacobians);
  ExpectDerivatives<1, 3, 3>(p_w.data(), ceres::EuclideanManifold<3>(), by_point,
                             [&](const double* x) { return residual(x, plane.data()); });
  ExpectDerivatives<1, 4, 3>(plane.data(), PlaneManifold(), by_plane,
                             [&](const double* x) { return residual(p_w.data(), x); });
}

TEST(PlaneBlock, HoldsThePlane) {
  const Plane again = PlaneOf(BlockOf(kPlane_w, kReference_w).data(), kReference_w);
  EXPECT_THAT(again, PlaneNear(kPlane_w, 1e-12, 1e-12));
}

TEST(PlaneManifold, HoldsCeresInvariantsAtThePolesToo) {
  using namespace ceres;  // the macro takes its names from there
  const PlaneManifold manifold;
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1e-12, 0, 1).normalized(),
        Eigen::Vector3d(0, 1e-9, -1).normalized(),
        Eigen::Vector3d(0.3, -0.5, 0.2).normalized()}) {
    Vector x(4), y(4), delta(3);
    x << n, 0.7;
    y << ExpSo3({0.4, -0.8, 0.3}) * n, -0.2;
    delta << 0.5, -0.9, 0.3;
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
  }
}

/// Anywhere, on an axis, or tilted from one by 1e-12 to 1e-3.
Eigen::Vector3d DrawNormal(Random& random) {
  Eigen::Vector3d n;
  for (double& x : n) x = Normal(random);
  const int kind = random.Below(10);
  if (kind < 8) return n.normalized();
  const double tilt = kind == 8 ? 0.0 : std::pow(10.0, -12 + 9 * random.Uniform());
  const double side = random.Below(2) == 0 ? 1.0 : -1.0;
  return (side * Eigen::Vector3d::Unit(random.Below(3)) + tilt * n).normalized();
}

TEST(PlaneManifold, HoldsCeresInvariantsEverywhere) {
  using namespace ceres;  // the macro takes its names from there
  const PlaneManifold manifold;
  slam::Random random{10};
  for (int k = 0; k < 1000; ++k) {
    SCOPED_TRACE(k);
    const Eigen::Vector3d n = DrawNormal(random);
    const double a = 2 * M_PI * random.Uniform();
    const auto turned = [&](double turn) {
      const Eigen::Vector2d along(std::cos(a), std::sin(a));
      const Eigen::Vector3d step = TangentBasis(n) * along;
      return Eigen::Vector3d((std::cos(turn) * n + std::sin(turn) * step).normalized());
    };
    const double far = 3.0 * random.Uniform(), d = random.Below(4) == 0 ? 0.0 : Normal(random);
    Vector x(4), y(4), delta(3);
    x << n, d;
    y << turned(3.0 * random.Uniform()), Normal(random);
    delta << far * std::cos(a), far * std::sin(a), Normal(random);
    EXPECT_THAT_MANIFOLD_INVARIANTS_HOLD(manifold, x, delta, y, 1e-9);
    if (HasFailure()) return;
  }
}

}  // namespace
}  // namespace slam
