// Where motion alone says where the camera is, planes are associated tens of centimetres beside the truth.
#include <gtest/gtest.h>

#include "slam/associate/associate_planes.h"
#include "slam/mapping/plane_update.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

PlaneWorld Desk(const Eigen::Vector3d& center_w) {
  PlaneWorld world;
  world.Add(center_w, {0.4, 0, 0}, {0, 0.3, 0}, "");
  return world;
}

/// The decision on a desk seen by a camera that thinks itself higher than it is, by so much; the map has
/// a desk at the origin.
PlaneDecision DecisionOn(const Eigen::Vector3d& center_w, double higher_m, double sigma_m) {
  const Camera camera = SmallCamera();
  const Pose first = LookAt({0, -0.9, 0.8}, {0, 0, 0}),
             second = LookAt({0.1, -0.9, 0.8}, {0, 0, 0});
  Map map;
  PlaneMapConfig config;
  config.min_pixels = 40, config.trial_frames = 1;  // one view is the map
  SeenWorld mapped = See(Desk({0, 0, 0}), first, camera, {}, Random{1});
  UpdatePlanes(mapped.frame, map, camera, {}, config);
  Frame frame = See(Desk(center_w), second, camera, {}, Random{2}).frame;
  const Eigen::Vector3d up_c = frame.T_cw.R * Eigen::Vector3d::UnitZ();
  frame.T_cw.t -= higher_m * up_c;
  Matrix6d covariance = 1e-5 * Matrix6d::Identity();
  covariance.topLeftCorner<3, 3>() += sigma_m * sigma_m * up_c * up_c.transpose();
  frame.pose_covariance = covariance;
  return AssociatePlanes(frame, map, camera, {}).matches.at(0).decision;
}

TEST(UncertainPose, IsNoReasonNotToRecogniseADesk) {
  for (const double higher_m : {-0.2, -0.1, 0.0, 0.1, 0.2}) {
    SCOPED_TRACE(higher_m);
    EXPECT_EQ(DecisionOn({0, 0, 0}, higher_m, 0.15), PlaneDecision::kMatched);
  }
  for (const double higher_m : {-0.2, 0.2}) {
    EXPECT_EQ(DecisionOn({0, 0, 0}, higher_m, 0.01), PlaneDecision::kUnmatched) << higher_m;
  }
}

TEST(UncertainPose, TakesNoDeskForOneBesideIt) {
  for (const double higher_m : {-0.2, 0.0, 0.2}) {
    EXPECT_EQ(DecisionOn({0.9, 0, 0}, higher_m, 0.15), PlaneDecision::kUnmatched) << higher_m;
  }
}

}  // namespace
}  // namespace slam
