#include "sim/base/angle.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sim {
namespace {

// The polynomials omit terms below 1e-17; a handful of roundings of 1.1e-16 remain, and the
// library's own argument carries one rounding of the angle (up to 7 rad: 9e-16).
constexpr double kRoundOff = 2e-15;

TEST(SinCosDeg, AgreesWithTheLibraryEverywhere) {
  for (int i = -7300; i <= 7300; ++i) {
    const double angle_deg = 0.05 * i + 0.001 * (i % 7);
    const SinCos mine = SinCosDeg(angle_deg);
    EXPECT_NEAR(mine.sin, std::sin(DegToRad(angle_deg)), kRoundOff) << angle_deg;
    EXPECT_NEAR(mine.cos, std::cos(DegToRad(angle_deg)), kRoundOff) << angle_deg;
  }
}

TEST(SinCosDeg, IsTheSameAfterManyTurnsEitherWay) {
  for (const double angle_deg : {-135.0, -90.0, -30.0, 0.0, 45.0, 100.0, 180.0}) {
    const SinCos once = SinCosDeg(angle_deg);
    for (const int turns : {-50, -3, -2, -1, 1, 2, 50}) {
      const SinCos again = SinCosDeg(angle_deg + 360.0 * turns);
      EXPECT_EQ(again.sin, once.sin) << angle_deg << " " << turns;
      EXPECT_EQ(again.cos, once.cos) << angle_deg << " " << turns;
    }
  }
}

TEST(SinCosDeg, IsExactAtRightAngles) {
  EXPECT_EQ(SinCosDeg(90).cos, 0);
  EXPECT_EQ(SinCosDeg(90).sin, 1);
  EXPECT_EQ(SinCosDeg(180).sin, 0);
  EXPECT_EQ(SinCosDeg(-90).sin, -1);
  EXPECT_EQ(SinCosDeg(360).cos, 1);
}

TEST(Atan2Rad, AgreesWithTheLibraryInEveryQuadrant) {
  for (int i = 0; i < 720; ++i) {
    const double angle = DegToRad(0.5 * i - 179.9);
    const double y = 3 * std::sin(angle), x = 3 * std::cos(angle);
    EXPECT_NEAR(Atan2Rad(y, x), std::atan2(y, x), 1e-14);
    EXPECT_NEAR(AsinRad(y / 3), std::asin(y / 3), 1e-7);  // steep at the ends, as asin is
  }
  EXPECT_EQ(Atan2Rad(0, 0), 0);
  EXPECT_NEAR(AsinRad(0.3), std::asin(0.3), 1e-14);
}

TEST(QuaternionFromRpyDeg, TurnsRollThenPitchThenYaw) {
  const Eigen::Vector3d rpy_deg(10, -20, 130);
  const Eigen::Matrix3d expected = (Eigen::AngleAxisd(DegToRad(130), Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(DegToRad(-20), Eigen::Vector3d::UnitY()) *
                                    Eigen::AngleAxisd(DegToRad(10), Eigen::Vector3d::UnitX()))
                                       .toRotationMatrix();
  const Eigen::Quaterniond q = QuaternionFromRpyDeg(rpy_deg);
  EXPECT_LT((q.toRotationMatrix() - expected).norm(), kRoundOff);
  EXPECT_LT((RpyDegFromQuaternion(q) - rpy_deg).norm(), 1e-12);
}

}  // namespace
}  // namespace sim
