#include "slam/diagnose/view_pair.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"

namespace slam {
namespace {

const Intrinsics kTrue(525.0, 520.0, 319.5, 239.5);
const Pose kT21{ExpSo3({0.08, -0.16, 0.06}), {0.05, -0.02, 0.03}};

Eigen::Vector2d PixelOf(const Eigen::Vector3d& p) {
  return {kTrue[0] * p.x() / p.z() + kTrue[2], kTrue[1] * p.y() / p.z() + kTrue[3]};
}

/// What shows at a pixel, z metres away.
Eigen::Vector3d PointAt(const Eigen::Vector2d& u_px, double z_m) {
  return z_m * Eigen::Vector3d((u_px.x() - kTrue[2]) / kTrue[0],
                               (u_px.y() - kTrue[3]) / kTrue[1], 1.0);
}

/// Points that a camera of these intrinsics sees from two places, exactly.
std::vector<TwiceSeen> SeenExactly(int count, const Pose& T_21) {
  Random random{5};
  std::vector<TwiceSeen> points;
  while (static_cast<int>(points.size()) < count) {
    const Eigen::Vector2d u(640 * random.Uniform(), 480 * random.Uniform());
    const double z = 0.8 + 2.0 * random.Uniform();
    const Eigen::Vector3d p_1 = PointAt(u, z), p_2 = T_21 * p_1;
    points.push_back({u, PixelOf(p_2), z, p_2.z(), 1.0});
  }
  return points;
}

TEST(ViewPair, OneStepFromEachSmallErrorLeadsToTheTrueIntrinsics) {
  for (int k = 0; k < 4; ++k) {
    Intrinsics error = Intrinsics::Zero();
    error[k] = 1.0;
    const ViewMotion motion{(Vector6d() << 0.1, 0.2, -0.1, 0.3, -0.4, 0.2).finished(),
                            (Vector6d() << -0.2, 0.1, 0.1, -0.2, 0.3, 0.3).finished(), 480.0};
    ViewPair pair(SeenExactly(120, kT21), kT21, motion);
    const IntrinsicsEvidence evidence = pair.Evidence(kTrue + error);
    ASSERT_TRUE(evidence.usable);
    const Intrinsics step = -evidence.information.ldlt().solve(evidence.gradient);
    // A pixel among 500: what is of second order is a few parts in a thousand.
    EXPECT_LT((step + error).norm(), 0.02) << k;
  }
}

/// Where the row that sees it finds a point that is at p when the middle row is read.
Eigen::Vector3d AtItsRow(const Eigen::Vector3d& p, double read_s, const Vector6d& speed) {
  Eigen::Vector3d at = p;
  for (int k = 0; k < 6; ++k) {
    const double row = PixelOf(at).y() / 480.0 - 0.5;
    at = Exp(row * read_s * speed) * p;
  }
  return at;
}

Pose Rolled(double roll_rad) {
  return {ExpSo3({0.08, -0.16, 0.0}) * ExpSo3({0, 0, roll_rad}), {0.05, -0.02, 0.03}};
}

/// By how many sigmas these views would have the true intrinsics changed.
double SigmasOff(const std::vector<TwiceSeen>& points, const Pose& T_21,
                 const ViewMotion& motion) {
  const IntrinsicsEvidence evidence = ViewPair(points, T_21, motion).Evidence(kTrue);
  EXPECT_TRUE(evidence.usable);
  const Intrinsics step = -evidence.information.ldlt().solve(evidence.gradient);
  return std::sqrt(step.dot(evidence.information * step));
}

TEST(ViewPair, ARollingShutterIsNoWrongCameraHoweverTheViewsAreTurned) {
  constexpr double kRead_s = 0.005;
  const ViewMotion motion{(Vector6d() << 0.1, 0.2, -0.1, 0.6, -0.8, 0.4).finished(),
                          (Vector6d() << -0.2, 0.1, 0.1, -0.2, 0.3, 0.3).finished(), 480.0};
  for (const double roll : {0.06, 0.8, 1.5}) {
    const Pose T_21 = Rolled(roll);
    std::vector<TwiceSeen> points = SeenExactly(200, T_21);
    for (TwiceSeen& point : points) {
      const Eigen::Vector3d p_1 = PointAt(point.first_u_px, point.first_z_m);
      const Eigen::Vector3d at_1 = AtItsRow(p_1, kRead_s, motion.first_per_s);
      const Eigen::Vector3d at_2 = AtItsRow(T_21 * p_1, kRead_s, motion.second_per_s);
      point = {PixelOf(at_1), PixelOf(at_2), at_1.z(), at_2.z(), 1.0};
    }
    EXPECT_LT(SigmasOff(points, T_21, motion), 1.0) << roll;
  }
}

TEST(ViewPair, DepthOfALaterTimeIsNoWrongCameraHoweverTheViewsAreTurned) {
  constexpr double kLate_s = 0.01;
  // The first camera comes nearer while it looks, the second goes away.
  const ViewMotion motion{(Vector6d() << 0.1, 0.2, -0.5, 0.6, -0.8, 0.4).finished(),
                          (Vector6d() << -0.2, 0.1, 0.6, -0.2, 0.3, 0.3).finished(), 480.0};
  for (const double roll : {0.06, 0.8, 1.5}) {
    const Pose T_21 = Rolled(roll);
    std::vector<TwiceSeen> points = SeenExactly(200, T_21);
    for (TwiceSeen& point : points) {
      const Eigen::Vector3d p_1 = PointAt(point.first_u_px, point.first_z_m);
      point.first_z_m = (Exp(kLate_s * motion.first_per_s) * p_1).z();
      point.second_z_m = (Exp(kLate_s * motion.second_per_s) * (T_21 * p_1)).z();
    }
    EXPECT_LT(SigmasOff(points, T_21, motion), 1.0) << roll;
  }
}

TEST(ViewPair, FindsTheMotionFromAPoorGuess) {
  const Pose guess =
      Exp((Vector6d() << 0.03, -0.02, 0.02, 0.02, -0.03, 0.02).finished()) * kT21;
  ViewPair pair(SeenExactly(120, kT21), guess, {});
  EXPECT_LT(pair.Evidence(kTrue).gradient.norm(), 1e-6);
}

// Points of coarse octaves err by more, and count by as much less.
TEST(ViewPair, HardlyHearsPointsThatAreKnownPoorly) {
  for (const double scale : {1.0, 100.0}) {
    std::vector<TwiceSeen> points = SeenExactly(180, kT21);
    for (std::size_t i = 0; i < points.size(); i += 3) {
      if (points[i].second_u_px.x() > kTrue[2]) points[i].second_u_px.x() += 1.0;
      points[i].scale = scale;
    }
    const IntrinsicsEvidence evidence = ViewPair(points, kT21, {}).Evidence(kTrue);
    ASSERT_TRUE(evidence.usable);
    const Intrinsics step = -evidence.information.ldlt().solve(evidence.gradient);
    if (scale > 1) {
      EXPECT_LT(step.norm(), 0.05);
    } else {
      EXPECT_GT(step.norm(), 0.5);
    }
  }
}

TEST(ViewPair, TranslationAloneSaysNothingOfFocalLengthOrCentre) {
  const Pose T_21{Eigen::Matrix3d::Identity(), {0.2, -0.1, 0.1}};
  ViewPair moved(SeenExactly(120, T_21), T_21, {}), turned(SeenExactly(120, kT21), kT21, {});
  const Intrinsics far_off(100.0, 100.0, 40.0, -30.0);
  const Eigen::Matrix4d says = moved.Evidence(kTrue).information;
  // Both focal lengths by one factor, or the centre: scenes that are stretched, sheared.
  const double all = turned.Evidence(kTrue).information.norm();
  EXPECT_LT(far_off.dot(says * far_off), 1e-6 * all * far_off.squaredNorm());
  EXPECT_GT(far_off.dot(turned.Evidence(kTrue).information * far_off),
            1e-3 * all * far_off.squaredNorm());
}

TEST(ViewPair, TooFewPointsAndPointsOfNoMotionAreNoEvidence) {
  ViewPair few(SeenExactly(static_cast<int>(ViewPair::kMinPoints) - 1, kT21), kT21, {});
  EXPECT_FALSE(few.Evidence(kTrue).usable);
  std::vector<TwiceSeen> mixed = SeenExactly(120, kT21);
  for (std::size_t i = 0; i + 1 < mixed.size(); ++i) {
    std::swap(mixed[i].second_u_px, mixed[i + 1].second_u_px);
  }
  ViewPair none(mixed, kT21, {});
  const IntrinsicsEvidence evidence = none.Evidence(kTrue);
  EXPECT_FALSE(evidence.usable);
  EXPECT_EQ(evidence.information.norm(), 0.0);
}

}  // namespace
}  // namespace slam
