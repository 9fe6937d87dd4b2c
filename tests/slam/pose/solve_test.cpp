#include "slam/pose/solve.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slam {
namespace {

TEST(StepIsSmall, LooksAtTheSizeOfEachAxisAndNotAtItsSign) {
  for (int axis = 0; axis < 6; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      Vector6d xi = Vector6d::Zero();
      xi[axis] = sign * 1e-6;
      EXPECT_FALSE(solve_detail::StepIsSmall(xi)) << axis << " " << sign;
      xi[axis] = sign * 1e-12;
      EXPECT_TRUE(solve_detail::StepIsSmall(xi)) << axis << " " << sign;
    }
  }
}

TEST(Nullity, IsTheSameInWhateverUnitLengthsAreMeasured) {
  Matrix6d root = Matrix6d::Zero();
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j <= i; ++j) root(i, j) = i == j ? 1.0 + 0.2 * i : std::sin(7.0 * i + j);
  }
  for (const int open : {0, 1, 3}) {  // turns about axes that nothing observes
    Matrix6d seen = root;
    seen.bottomRows(open).setZero();
    const Matrix6d H = seen * seen.transpose();
    for (int exponent = -14; exponent <= 14; ++exponent) {
      Vector6d unit = Vector6d::Ones();
      unit.head<3>() *= std::pow(10.0, exponent);
      EXPECT_EQ(Nullity(unit.asDiagonal() * H * unit.asDiagonal()), open) << exponent;
    }
  }
}

}  // namespace
}  // namespace slam
