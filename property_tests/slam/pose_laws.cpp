#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "property_tests/generators/poses.h"
#include "tests/support/numeric_jacobian.h"

namespace slam {
namespace {

double Difference(const Pose& a, const Pose& b) {
  return (a.R - b.R).cwiseAbs().maxCoeff() + (a.t - b.t).norm();
}

// Worst values of straightforward code: 3e-15 (inverse), 2.5e-14 m (products of poses of 15 m).
RC_GTEST_PROP(PoseGroup, ComposesWithItsInverseToTheIdentity, ()) {
  const Pose T = AnyPose(10);
  RC_ASSERT(Difference(T * Inverse(T), Pose{}) < 1e-13 * (1 + T.t.norm()));
  RC_ASSERT(Difference(T * Pose{}, T) == 0.0);
}

RC_GTEST_PROP(PoseGroup, IsAssociative, ()) {
  const Pose A = AnyPose(5), B = AnyPose(5), C = AnyPose(5);
  RC_ASSERT(Difference((A * B) * C, A * (B * C)) <
            1e-13 * (1 + A.t.norm() + B.t.norm() + C.t.norm()));
}

// Bounds are three times what round-off came to in 40,000 draws.
RC_GTEST_PROP(PoseGroup, IsTheThousandthPowerOfAStepAfterAThousandProducts, ()) {
  const Pose step = AnyMotion(0.5, 0.1);
  Pose T;
  for (int i = 0; i < 1000; ++i) T = step * T;
  // Before anything is normalised.
  RC_ASSERT((T.R * T.R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <
            6e-13);
  RC_ASSERT(std::abs(T.R.determinant() - 1) < 6e-13);
  const Pose power = Exp(1000 * Log(step));
  RC_ASSERT((T.R - power.R).cwiseAbs().maxCoeff() < 8e-13);
  RC_ASSERT((T.t - power.t).norm() < 2e-13 * (1 + 1000 * step.t.norm()));
  const Pose exact = Normalised(T);
  RC_ASSERT((exact.R * exact.R.transpose()).isIdentity(1e-14));
  RC_ASSERT((exact.R - T.R).cwiseAbs().maxCoeff() < 6e-13);  // it is the nearest
  RC_ASSERT(exact.t == T.t);
}

RC_GTEST_PROP(PoseExponential, LogUndoesExp, ()) {
  Vector6d xi;
  const Eigen::Vector3d axis = AnyUnit();
  xi << AnyPoint(3), std::min(AnyAngle(), M_PI - 1e-6) * axis;
  RC_ASSERT((Log(Exp(xi)) - xi).norm() < 1e-12 * std::max(1.0, xi.norm()));
}

RC_GTEST_PROP(PoseExponential, ExpUndoesLog, ()) {
  const Pose T = AnyPose(10);
  RC_ASSERT(Difference(Exp(Log(T)), T) < 1e-12 * (1 + T.t.norm()));
}

// At pi either axis is right, but the rotation must be the same.
RC_GTEST_PROP(PoseExponential, HalfATurnIsFoundAboutEitherEndOfItsAxis, ()) {
  const Eigen::Vector3d axis = AnyUnit();
  const double short_of_pi = AnyInt(0, 2) == 0 ? 0.0 : std::pow(10.0, AnyReal(-16, -5));
  const Eigen::Matrix3d R = ExpSo3((M_PI - short_of_pi) * axis);
  const Eigen::Vector3d omega = LogSo3(R);
  RC_ASSERT(omega.norm() <= M_PI + 1e-14);
  RC_ASSERT(std::abs(omega.norm() - (M_PI - short_of_pi)) < 1e-14);
  RC_ASSERT(std::min((omega - M_PI * axis).norm(), (omega + M_PI * axis).norm()) <
            2 * short_of_pi + 1e-13);
  RC_ASSERT((ExpSo3(omega) - R).cwiseAbs().maxCoeff() < 1e-13);
  // By its matrix alone: 2 a a^T - I, exactly symmetric, about any axis.
  const Eigen::Matrix3d half = 2 * axis * axis.transpose() - Eigen::Matrix3d::Identity();
  RC_ASSERT(std::abs(LogSo3(half).norm() - M_PI) < 1e-13);
  RC_ASSERT((ExpSo3(LogSo3(half)) - half).cwiseAbs().maxCoeff() < 1e-13);
}

RC_GTEST_PROP(PoseExponential, AdjointCarriesAStepToTheOtherSide, ()) {
  const Pose T = AnyPose(3);
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = AnyReal(-1, 1);
  RC_ASSERT(Difference(T * Exp(xi), Exp(Adjoint(T) * xi) * T) < 1e-12);
}

RC_GTEST_PROP(PoseExponential, PointJacobianAgreesWithDifferences, ()) {
  const Pose T = AnyPose(5);
  const Eigen::Vector3d x = AnyPoint(5);
  Eigen::Matrix<double, 3, 6> J;
  J << Eigen::Matrix3d::Identity(), -Hat(T * x);
  const auto numeric =
      NumericJacobian<3>(T, [&](const Pose& M) { return Eigen::Vector3d(M * x); });
  RC_ASSERT(JacobianError(J, numeric) < 1e-8);
  RC_ASSERT(JacobianError(-J, numeric) > 1e-3);
}

RC_GTEST_PROP(PoseGroup, RotationAngleIsSymmetricAndUnmovedByAThirdPose, ()) {
  const Pose A = AnyPose(5), B = AnyPose(5), T = AnyPose(5);
  RC_ASSERT(std::abs(RotationAngle(A, B) - RotationAngle(B, A)) < 1e-12);
  RC_ASSERT(std::abs(RotationAngle(T * A, T * B) - RotationAngle(A, B)) < 1e-7);
}

}  // namespace
}  // namespace slam
