#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

#include "property_tests/generators/planes.h"
#include "slam/associate/plane_gates.h"

namespace slam {
namespace {

// Coordinates stay below 70 m and each law is under 50 flops: 50 * 70 * 2^-53 < 4e-13.
constexpr double kRoundOff_m = 1e-12;

struct Pair {
  Plane pi_c, pi_w;
  Eigen::Vector3d centroid_c;
  std::vector<Eigen::Vector3d> edge_points_c;
  Pose T_cw;
};

Pair AnyPair() {
  Pair pair;
  const SeenPlane seen = AnySeenPlane();
  pair.pi_c = seen.pi_c;
  pair.centroid_c = seen.point_c;
  for (int i = 0; i < 8; ++i) {
    pair.edge_points_c.push_back(ProjectOnto(seen.pi_c, seen.point_c + AnyPoint(0.3)));
  }
  pair.T_cw = AnyPose(5);
  pair.pi_w = Transform(Inverse(AnyMotion(0.2, 0.1) * pair.T_cw), seen.pi_c);
  return pair;
}

RC_GTEST_PROP(PlaneGatesEq7, OffsetIgnoresWhereTheWorldOriginLies, ()) {
  const PlaneGateConfig open{.max_normal_angle_rad = 4,
                             .max_patch_offset_m = 1e3,
                             .max_edge_point_distance_m = 0.05,
                             .min_edge_point_ratio = 0};
  const Pair p = AnyPair();
  const Pose T_vw = AnyPose(10);  // v: the same world, moved
  const auto here = TestPlaneGates(p.pi_c, p.centroid_c, p.edge_points_c, p.pi_w, p.T_cw, open);
  const auto there = TestPlaneGates(p.pi_c, p.centroid_c, p.edge_points_c,
                                    Transform(T_vw, p.pi_w), p.T_cw * Inverse(T_vw), open);
  RC_ASSERT(std::abs(here.value() - there.value()) < 10 * kRoundOff_m);
}

RC_GTEST_PROP(PlaneGatesEq6, TighterGatesNeverAcceptMore, ()) {
  const Pair p = AnyPair();
  PlaneGateConfig wide, tight;
  wide.max_normal_angle_rad = AnyReal(0.01, 0.5);
  wide.max_patch_offset_m = AnyReal(0.001, 0.2);
  wide.max_edge_point_distance_m = AnyReal(0.001, 0.2);
  wide.min_edge_point_ratio = AnyReal(0, 0.8);
  tight.max_normal_angle_rad = wide.max_normal_angle_rad * AnyReal(0, 1);
  tight.max_patch_offset_m = wide.max_patch_offset_m * AnyReal(0, 1);
  tight.max_edge_point_distance_m = wide.max_edge_point_distance_m * AnyReal(0, 1);
  tight.min_edge_point_ratio = wide.min_edge_point_ratio + AnyReal(0, 0.2);
  const auto with = [&](const PlaneGateConfig& config) {
    return TestPlaneGates(p.pi_c, p.centroid_c, p.edge_points_c, p.pi_w, p.T_cw, config)
        .has_value();
  };
  RC_ASSERT(!with(tight) || with(wide));
}

}  // namespace
}  // namespace slam
