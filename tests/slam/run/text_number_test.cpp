#include "slam/run/text_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace slam {
namespace {

TEST(FiniteNumberText, IsTheShortestThatReadsBackAndNeverMinusZero) {
  for (const double x : {0.1, 1.0 / 3, -0.0, 1e-300, 123456789.125, 5e-324}) {
    EXPECT_EQ(std::strtod(FiniteNumberText(x).c_str(), nullptr), x);
  }
  EXPECT_EQ(FiniteNumberText(-0.0), "0");
  EXPECT_THROW(FiniteNumberText(std::nan("")), std::invalid_argument);
}

TEST(StampText, KeepsTumsSixDecimalsAndAddsDigitsOnlyWhereNeeded) {
  EXPECT_EQ(StampText(1305031102.175304), "1305031102.175304");
  EXPECT_EQ(StampText(0), "0.000000");
  EXPECT_EQ(StampText(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(StampText(1e-7), "0.0000001");
}

TEST(TrajectoryLine, GivesTheCameraInTheWorldByTheQuaternionOfTheLesserHalf) {
  for (int i = 0; i < 24; ++i) {  // turns up to three half ones about slanted axes
    const double turn_rad = 0.4 * (i + 1);
    const Eigen::Vector3d axis = Eigen::Vector3d(i % 3 - 1.0, 0.5, i % 2 - 0.5).normalized();
    const Pose T_cw{ExpSo3(turn_rad * axis), {0.1 * i, -2, 3}};
    std::istringstream words(TrajectoryLine(1.5, T_cw));
    double s, x, y, z, qx, qy, qz, qw;
    ASSERT_TRUE(words >> s >> x >> y >> z >> qx >> qy >> qz >> qw);
    // p_w = q p_c q* + t, by its definition.
    const Eigen::Vector3d v(qx, qy, qz), p_c(0.3, -0.7, 1.1);
    const Eigen::Vector3d turned = p_c + 2 * qw * v.cross(p_c) + 2 * v.cross(v.cross(p_c));
    const Eigen::Vector3d p_w = turned + Eigen::Vector3d(x, y, z);
    EXPECT_LT((T_cw * p_w - p_c).norm(), 1e-12) << i;
    EXPECT_GE(qw, 0.0) << i;
    EXPECT_EQ(s, 1.5);
  }
}

}  // namespace
}  // namespace slam
