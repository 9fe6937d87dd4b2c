#include "slam/mapping/bundle/in_plane_terms.h"

#include <gmock/gmock.h>

#include "slam/pose/plane_constraints.h"
#include "tests/support/block_derivatives.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Pose kSeenFrom_cw{ExpSo3({0.1, 0.2, -0.1}), {0.1, 0, 0.2}};
const Plane kTop_w{Eigen::Vector3d(0.2, 0.3, -0.9).normalized(), 1.9};
const Eigen::Vector3d kMiddle_w = ProjectOnto(kTop_w, {0.3, -0.2, 1.9});
const PlaneAxes kAxes(kTop_w, kMiddle_w);
/// The plane as an adjustment may have left it.
const Plane kMoved_w{ExpSo3({0.1, -0.2, 0.05}) * kTop_w.n, 1.87};

Eigen::Vector3d PlaceOf(const Plane& pi_w, const InPlaneBlock& block) {
  const InPlanePoint point = PointOf(kAxes, BlockOf(pi_w, kMiddle_w).data(), block.data());
  EXPECT_TRUE(point.valid);
  return point.p_w;
}

TEST(InPlanePoint, LiesOnThePlaneStraightOverItsTwoNumbers) {
  const InPlaneBlock block{0.25, -0.4};
  for (const Plane& pi_w : {kTop_w, kMoved_w}) {
    const Eigen::Vector3d p_w = PlaceOf(pi_w, block);
    EXPECT_NEAR(SignedDistance(pi_w, p_w), 0, 1e-12);
    EXPECT_THAT(kAxes.BlockOf(p_w), ::testing::Pointwise(::testing::DoubleNear(1e-12), block));
  }
  // A shift along the normal takes the point along; a turn leaves its two numbers.
  const Plane shifted{kTop_w.n, kTop_w.d - 0.03};
  EXPECT_LT((PlaceOf(shifted, block) - PlaceOf(kTop_w, block) - 0.03 * kTop_w.n).norm(), 1e-12);
}

TEST(InPlanePoint, OfAPlaneTurnedAwayFromItsAxesIsNone) {
  const Eigen::Vector3d across = TangentBasis(kTop_w.n).col(0);
  for (const double turn_deg : {59.0, 61.0}) {
    const Plane turned{ExpSo3(turn_deg * M_PI / 180 * across) * kTop_w.n, 1.9};
    const InPlaneBlock block{0.1, 0.1};
    const PlaneBlock plane = BlockOf(turned, kMiddle_w);
    EXPECT_EQ(PointOf(kAxes, plane.data(), block.data()).valid, turn_deg < 60) << turn_deg;
    const Camera camera;
    const BundleTerm seen({kMiddle_w, {0, 0}}, camera);
    const InPlaneTerm<3> term(seen, kAxes);
    const PoseBlock pose = BlockOf(kSeenFrom_cw);
    const double* parameters[] = {pose.data(), plane.data(), block.data()};
    Eigen::Vector3d r;
    EXPECT_EQ(term.Evaluate(parameters, r.data(), nullptr), turn_deg < 60) << turn_deg;
  }
}

/// A corner that was measured 10 and 4 mm off along the plane, one axis known worse.
VertexConstraint MeasuredCorner() {
  Vertex seen;
  const Plane pi_c = Transform(kSeenFrom_cw, kMoved_w);
  const Eigen::Matrix<double, 3, 2> along = TangentBasis(pi_c.n);
  seen.p_c =
      kSeenFrom_cw * PlaceOf(kMoved_w, {0.1, 0.2}) + along * Eigen::Vector2d(0.01, 0.004);
  seen.covariance_c = 16e-6 * along.col(0) * along.col(0).transpose();
  return MakeVertexConstraint(seen, pi_c, 0);
}

TEST(VertexTerm, CountsSigmasAlongThePlaneAlone) {
  const VertexTerm term(MeasuredCorner());
  const PoseBlock pose = BlockOf(kSeenFrom_cw);
  for (const double up_m : {0.0, 0.05}) {
    const Eigen::Vector3d p_w = PlaceOf(kMoved_w, {0.1, 0.2}) + up_m * kMoved_w.n;
    const double* parameters[] = {pose.data(), p_w.data()};
    Eigen::Vector2d r;
    ASSERT_TRUE(term.Evaluate(parameters, r.data(), nullptr));
    // 3 mm besides what is known of the corner.
    EXPECT_NEAR(r.squaredNorm(), 0.01 * 0.01 / 25e-6 + 0.004 * 0.004 / 9e-6, 1e-9);
  }
}

/// Derivatives by pose, plane and the point's two numbers.
template <int kRows>
void ExpectDerivativesOf(const ceres::SizedCostFunction<kRows, 7, 3>& of_point) {
  const InPlaneTerm<kRows> term(of_point, kAxes);
  const PoseBlock pose = BlockOf(kSeenFrom_cw);
  const PlaneBlock plane = BlockOf(kMoved_w, kMiddle_w);
  const InPlaneBlock point{0.1, 0.2};
  using Row = Eigen::Matrix<double, kRows, 1>;
  const auto residual = [&](const double* at_pose, const double* at_plane, const double* at) {
    const double* parameters[] = {at_pose, at_plane, at};
    Row r;
    EXPECT_TRUE(term.Evaluate(parameters, r.data(), nullptr));
    return r;
  };
  Eigen::Matrix<double, kRows, 7, Eigen::RowMajor> by_pose;
  Eigen::Matrix<double, kRows, 4, Eigen::RowMajor> by_plane;
  Eigen::Matrix<double, kRows, 2, Eigen::RowMajor> by_point;
  double* jacobians[] = {by_pose.data(), by_plane.data(), by_point.data()};
  const double* parameters[] = {pose.data(), plane.data(), point.data()};
  Row r;
  ASSERT_TRUE(term.Evaluate(parameters, r.data(), jacobians));
  EXPECT_GT(r.norm(), 1.0);
  ExpectDerivatives<kRows, 7, 6>(pose.data(), PoseManifold(), by_pose, [&](const double* x) {
    return residual(x, plane.data(), point.data());
  });
  ExpectDerivatives<kRows, 4, 3>(plane.data(), PlaneManifold(), by_plane, [&](const double* x) {
    return residual(pose.data(), x, point.data());
  });
  ExpectDerivatives<kRows, 2, 2>(
      point.data(), ceres::EuclideanManifold<2>(), by_point,
      [&](const double* x) { return residual(pose.data(), plane.data(), x); });
}

TEST(InPlaneTerm, HasTheDerivativesOfItsDifferenceQuotients) {
  ExpectDerivativesOf<2>(VertexTerm(MeasuredCorner()));
  const Camera camera;
  const Eigen::Vector3d p_w = PlaceOf(kMoved_w, {0.1, 0.2}), x_c = kSeenFrom_cw * p_w;
  const PointConstraint seen{p_w, camera.Project(x_c) + Eigen::Vector2d(3, -2), 1.0,
                             x_c.z() + 0.02, 0.01};
  ExpectDerivativesOf<3>(BundleTerm(seen, camera));
}

}  // namespace
}  // namespace slam
