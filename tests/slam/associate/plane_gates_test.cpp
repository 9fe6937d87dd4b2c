#include "slam/associate/plane_gates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace slam {
namespace {

// A board seen head-on from one metre.
const Plane kBoard{-Eigen::Vector3d::UnitZ(), 1.0};
const Eigen::Vector3d kCentroid(0, 0, 1);
const std::vector<Eigen::Vector3d> kEdge{{-.2, 0, 1}, {.2, 0, 1}, {0, .3, 1}, {0, -.3, 1}};

TEST(PlaneGatesEq6, AcceptsThePlaneItself) {
  const auto result = TestPlaneGates(kBoard, kCentroid, kEdge, kBoard, Pose{}, {});
  ASSERT_TRUE(result.has_value());
  EXPECT_EQ(result.value(), 0.0);
}

TEST(PlaneGatesEq6, RefusesTheBackOfAThinBoard) {
  const Plane back{-kBoard.n, -kBoard.d};
  const auto result = TestPlaneGates(kBoard, kCentroid, kEdge, back, Pose{}, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error(), PairRefusal::kNormalAngle);
}

TEST(PlaneGatesEq6, AsPrintedTakesTheBackForTheFront) {
  const double printed = std::acos(std::abs(kBoard.n.dot(-kBoard.n)));  // the form we left
  EXPECT_LT(printed, PlaneGateConfig{}.max_normal_angle_rad);
}

// One degree of error in the normal at five metres from the world's origin: the printed offset
// |t.n_c + d_c - d_w| is 87 mm although the patch lies on the map plane.
TEST(PlaneGatesEq7, AcceptsATiltedMeasurementOfAPatchFarFromTheOrigin) {
  const Pose T_cw{Eigen::Matrix3d::Identity(), {-5, 0, 0}};
  const Plane pi_w = Transform(Inverse(T_cw), kBoard);
  const Eigen::Vector3d n = ExpSo3({0, M_PI / 180, 0}) * kBoard.n;
  const Plane measured{n, -n.dot(kCentroid)};
  PlaneGateConfig strict;
  strict.min_edge_point_ratio = 0.999;
  strict.max_edge_point_distance_m = 1e-9;
  const auto result = TestPlaneGates(measured, kCentroid, kEdge, pi_w, T_cw, strict);
  EXPECT_TRUE(result.has_value());
  const double printed = std::abs(T_cw.t.dot(measured.n) + measured.d - pi_w.d);
  EXPECT_GT(printed, strict.max_patch_offset_m);
}

// The decoy must be nearer than the patch: only points behind the map plane (negative distance)
// tell the absolute value from the printed form.
TEST(PlaneGatesEq8, RefusesAPatchTwentyCentimetresBehindTheMapPlane) {
  const Plane nearer{kBoard.n, 0.8};
  const auto result = TestPlaneGates(kBoard, kCentroid, kEdge, nearer, Pose{}, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error(), PairRefusal::kOffsetAndEdgePoints);
  // As printed, every one of these points passes.
  for (const Eigen::Vector3d& B_c : kEdge) {
    EXPECT_LT(SignedDistance(nearer, B_c), PlaneGateConfig{}.max_edge_point_distance_m);
  }
}

TEST(PlaneGatesEq8, AcceptsByEdgePointsWhatTheCentroidAloneRefuses) {
  const Eigen::Vector3d off_centre(0, 0, 1.2);
  const auto result = TestPlaneGates(kBoard, off_centre, kEdge, kBoard, Pose{}, {});
  ASSERT_TRUE(result.has_value());
  EXPECT_GT(result.value(), PlaneGateConfig{}.max_patch_offset_m);
}

TEST(PlaneGatesEq8, RefusesAPatchWithoutEdgePoints) {
  const auto result = TestPlaneGates(kBoard, kCentroid, {}, kBoard, Pose{}, {});
  ASSERT_FALSE(result.has_value());
  EXPECT_EQ(result.error(), PairRefusal::kNoEdgePoints);
}

TEST(PlaneGatesEq6, RefusesWhatIsNotANumber) {
  const Plane nan{Eigen::Vector3d::Constant(std::nan("")), 1.0};
  EXPECT_FALSE(TestPlaneGates(nan, kCentroid, kEdge, kBoard, Pose{}, {}).has_value());
}

}  // namespace
}  // namespace slam
