#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "property_tests/generators/poses.h"
#include "slam/pose/pose_error.h"

namespace slam {
namespace {

/// Of a pose, all of it correlated, with metres and radians of any size to each other.
Matrix6d AnyCovariance() {
  Matrix6d root;
  for (int i = 0; i < 36; ++i) root(i) = AnyReal(-1, 1);
  Vector6d size;
  for (int i = 0; i < 6; ++i) size[i] = std::pow(10.0, AnyReal(-3, -1));
  return size.asDiagonal() * (root * root.transpose() + 0.01 * Matrix6d::Identity()) *
         size.asDiagonal();
}

double LeastVarianceOver(const Matrix6d& larger, const Matrix6d& smaller) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(larger, smaller).eigenvalues()[0];
}

double Difference(const Matrix6d& a, const Matrix6d& b) {
  const Vector6d size = b.diagonal().cwiseSqrt().cwiseInverse();
  return (size.asDiagonal() * (a - b) * size.asDiagonal()).cwiseAbs().maxCoeff();
}

RC_GTEST_PROP(CovarianceAtLeast, IsNowhereSmallerThanEither, ()) {
  const Matrix6d one = AnyCovariance(), other = AnyCovariance();
  const Matrix6d both = AtLeast(one, other);
  RC_ASSERT(LeastVarianceOver(both, one) > 1 - 1e-8);
  RC_ASSERT(LeastVarianceOver(both, other) > 1 - 1e-8);
}

TEST(CovarianceAtLeast, IsTheSumWhereOneKnowsAnAxisExactly) {
  Vector6d exact = Vector6d::Ones();
  exact[2] = 0;
  const Matrix6d one = exact.asDiagonal(), other = 4 * Matrix6d::Identity();
  EXPECT_EQ(AtLeast(one, other), Matrix6d(one + other));
}

RC_GTEST_PROP(CovarianceAtLeast, IsTheLargerOneWhereItIsSoEverywhere, ()) {
  const Matrix6d one = AnyCovariance();
  RC_ASSERT(Difference(AtLeast(one, Matrix6d::Zero()), one) < 1e-9);
  RC_ASSERT(Difference(AtLeast(one, AnyReal(0, 1) * one), one) < 1e-9);
  const double larger = AnyReal(1, 100);
  RC_ASSERT(Difference(AtLeast(one, larger * one), larger * one) < 1e-9);
}

RC_GTEST_PROP(CovarianceAtLeast, IsTheSameInAnyAxes, ()) {
  const Matrix6d one = AnyCovariance(), other = AnyCovariance();
  const Matrix6d carry = Adjoint(AnyPose(2));
  const Matrix6d carried =
      AtLeast(carry * one * carry.transpose(), carry * other * carry.transpose());
  RC_ASSERT(Difference(carried, carry * AtLeast(one, other) * carry.transpose()) < 1e-6);
}

RC_GTEST_PROP(CovarianceAtLeast, TakesOfTheBoundNoMoreThanTheAxisInWhichItIsLarger, ()) {
  const Vector6d variances = AnyCovariance().diagonal();
  Vector6d bound = Vector6d::Zero(), expected = variances;
  const int axis = AnyInt(0, 5);
  bound[axis] = variances[axis] * AnyReal(0, 4);
  expected[axis] = std::max(variances[axis], bound[axis]);
  RC_ASSERT(Difference(AtLeast(variances.asDiagonal(), bound.asDiagonal()),
                       expected.asDiagonal()) < 1e-9);
}

}  // namespace
}  // namespace slam
