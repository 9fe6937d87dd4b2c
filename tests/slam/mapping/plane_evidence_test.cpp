#include "slam/mapping/plane_evidence.h"

#include <gmock/gmock.h>

#include <cmath>

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
  for (int i = 0; i < 4; ++i) AddEvidence(estimate, plane, Frame{}, Pose{}, 1.0);
  EXPECT_NEAR(BestKnown(estimate).angle_sigma_rad, 5e-4, 1e-9);
  EXPECT_NEAR(BestKnown(estimate).offset_sigma_m, 5e-5, 1e-9);
}

/// What is known after `frames` views by a sensor that bends, the camera moving by `step` (of its own
/// frames) from each to the next.
PlaneEvidence KnownFrom(int frames, const Pose& step) {
  FramePlane plane;
  plane.pi_c = kSurface_w;
  plane.centroid_c = ProjectOnto(kSurface_w, {0, 0, 1.7});
  plane.angle_sigma_rad = plane.offset_sigma_m = 1e-5;
  plane.bend_angle_sigma_rad = plane.bend_offset_sigma_m = 0.01;
  PlaneEstimate estimate;
  Frame frame;
  for (int i = 0; i < frames; ++i) {
    AddEvidence(estimate, plane, frame, Pose{}, 1.0);
    frame.T_lc = Inverse(step);
  }
  return BestKnown(estimate);
}

Pose Turn(double angle_rad) { return {ExpSo3({0, angle_rad, 0}), Eigen::Vector3d::Zero()}; }

TEST(PlaneEvidence, OfViewsThroughOtherBendsIsIndependent) {
  for (const double turns : {1.0, 5.0}) {
    const PlaneEvidence known = KnownFrom(16, Turn(turns * kViewOfOneBend_rad));
    EXPECT_NEAR(known.offset_sigma_m, 0.01 / 4, 1e-6);
    EXPECT_NEAR(known.angle_sigma_rad, 0.01 / 4, 1e-6);
  }
}

TEST(PlaneEvidence, FromOnePlaceBearsTheBendThatItsViewsShare) {
  EXPECT_NEAR(KnownFrom(1, Pose{}).offset_sigma_m, 0.01, 1e-6);
  EXPECT_NEAR(KnownFrom(30, Pose{}).offset_sigma_m, 0.01, 2e-4);
}

TEST(PlaneEvidence, GrowsWithTheWayAndNotWithTheNumberOfFrames) {
  // A view more on the way, in one step or in ten.
  EXPECT_NEAR(KnownFrom(11, Turn(0.1 * kViewOfOneBend_rad)).offset_sigma_m,
              KnownFrom(2, Turn(kViewOfOneBend_rad)).offset_sigma_m, 1e-6);
  // A way moves the view by its angle as seen from the surface.
  const double distance_m = ProjectOnto(kSurface_w, {0, 0, 1.7}).norm();
  const Pose way{Eigen::Matrix3d::Identity(), {0.1 * kViewOfOneBend_rad * distance_m, 0, 0}};
  EXPECT_NEAR(KnownFrom(11, way).offset_sigma_m, 0.01 / std::sqrt(2.0), 1e-6);
}

TEST(PlaneEvidence, SaysTheSameOfANormalHoweverTheWorldIsTurned) {
  // A strip that was seen at both ends is known better along it than across.
  std::vector<double> sigmas;
  for (const double turned_rad : {0.0, 0.5, 0.8}) {
    const Pose T_new_old{ExpSo3({0, 0, turned_rad}), {0, 0, 0}};
    PlaneEstimate estimate;
    for (const double x : {0.0, 3.0}) {
      AddObservation(estimate, {Eigen::Vector3d::UnitZ(), 0.0},
                     T_new_old * Eigen::Vector3d(x, 0, 0), 0.01, 0.005, 1.0);
    }
    sigmas.push_back(BestKnown(estimate).angle_sigma_rad);
  }
  EXPECT_NEAR(sigmas[0], 0.01 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(sigmas[1], sigmas[0], 1e-9);
  EXPECT_NEAR(sigmas[2], sigmas[0], 1e-9);
}

}  // namespace
}  // namespace slam
