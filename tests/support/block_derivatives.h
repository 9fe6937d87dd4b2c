#pragma once

#include <ceres/manifold.h>
#include <gtest/gtest.h>

#include <Eigen/Core>

namespace slam {

/// Compares the derivatives by one block with difference quotients along its manifold's steps.
template <int kRows, int kAmbient, int kTangent, typename Residual>
void ExpectDerivatives(const double* block, const ceres::Manifold& manifold,
                       const Eigen::Matrix<double, kRows, kAmbient, Eigen::RowMajor>& analytic,
                       const Residual& residual) {
  constexpr double kStep = 1e-6, kTolerance = 1e-4;  // of derivatives up to 1e3
  using Tangent = Eigen::Matrix<double, kTangent, 1>;
  Eigen::Matrix<double, kAmbient, kTangent, Eigen::RowMajor> by_step;
  manifold.PlusJacobian(block, by_step.data());
  for (int i = 0; i < kTangent; ++i) {
    Eigen::Matrix<double, kAmbient, 1> forth, back;
    const Tangent plus = kStep * Tangent::Unit(i), minus = -plus;
    manifold.Plus(block, plus.data(), forth.data());
    manifold.Plus(block, minus.data(), back.data());
    const Eigen::Matrix<double, kRows, 1> slope =
        (residual(forth.data()) - residual(back.data())) / (2 * kStep);
    EXPECT_LT((analytic * by_step.col(i) - slope).norm(), kTolerance) << "direction " << i;
  }
}

}  // namespace slam
