#include "slam/pose/solve.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace slam
