#include "slam/mapping/plane_evidence.h"

#include <gmock/gmock.h>

#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Plane kSurface_w{Eigen::Vector3d(0.1, 0.2, -1).normalized(), 1.7};

TEST(PlaneEvidence, IsKnownBestBetweenThePlacesWhereItWasSeenAndSaysWhatWasSeen) {
  PlaneEstimate estimate;
  const Eigen::Vector3d one(0.3, 0.1, 1.5), other(-0.5, 0.1, 1.5);
  AddObservation(estimate, kSurface_w, one, 0.02, 0.004, 1.0);
  PlaneEvidence known = BestKnown(estimate);
  EXPECT_THAT(known.pi, PlaneNear(kSurface_w, 1e-9, 1e-9));
  EXPECT_THAT(known.centroid, VectorNear(ProjectOnto(kSurface_w, one), 1e-6));
  EXPECT_NEAR(known.angle_sigma_rad, 0.02, 1e-9);
  EXPECT_NEAR(known.offset_sigma_m, 0.004, 1e-9);
  AddObservation(estimate, kSurface_w, other, 0.02, 0.004, 1.0);
  known = BestKnown(estimate);
  EXPECT_THAT(known.centroid, VectorNear(ProjectOnto(kSurface_w, 0.5 * (one + other)), 1e-6));
  EXPECT_NEAR(known.offset_sigma_m, 0.004 / std::sqrt(2.0), 1e-9);
}

TEST(PlaneEvidence, OfASensorThatBendsNothingIsWorthItsFit) {
  FramePlane plane;
  plane.pi_c = kSurface_w;
  plane.centroid_c = ProjectOnto(kSurface_w, {0, 0, 1.7});
  plane.angle_sigma_rad = 1e-3, plane.offset_sigma_m = 1e-4;
  PlaneEstimate estimate;
  for (int i = 0; i < 4; ++i) AddEvidence(estimate, plane, Pose{}, 1.0);
  EXPECT_NEAR(BestKnown(estimate).angle_sigma_rad, 5e-4, 1e-9);
  EXPECT_NEAR(BestKnown(estimate).offset_sigma_m, 5e-5, 1e-9);
}

TEST(PlaneEvidence, ThatFollowsAnotherBearsTheBendTheyShare) {
  FramePlane plane;
  plane.pi_c = kSurface_w;
  plane.centroid_c = ProjectOnto(kSurface_w, {0, 0, 1.7});
  plane.angle_sigma_rad = plane.offset_sigma_m = 1e-4;
  plane.bend_angle_sigma_rad = plane.bend_offset_sigma_m = 0.01;
  PlaneEstimate estimate;
  AddEvidence(estimate, plane, Pose{}, 1.0);
  EXPECT_NEAR(BestKnown(estimate).offset_sigma_m, 0.01, 1e-4);
  // Ten more are worth as much as the first.
  for (int i = 0; i < 10; ++i) AddEvidence(estimate, plane, Pose{}, 1.0);
  EXPECT_NEAR(BestKnown(estimate).offset_sigma_m, 0.01 / std::sqrt(2.0), 1e-4);
}

}  // namespace
}  // namespace slam
