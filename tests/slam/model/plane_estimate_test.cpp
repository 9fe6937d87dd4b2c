#include "slam/model/plane_estimate.h"

#include <gtest/gtest.h>

#include <array>

namespace slam {
namespace {

/// A desk's patch as one frame sees it.
struct SeenPatch {
  Eigen::Vector3d centroid_w;
  double offset_sigma_m, world_variance_m2;
};

PlaneEstimate EstimateOf(const std::array<SeenPatch, 3>& patches, double keep) {
  PlaneEstimate estimate;
  for (const SeenPatch& seen : patches) {
    AddObservation(estimate, {Eigen::Vector3d::UnitZ(), -0.7}, seen.centroid_w, 0.02,
                   seen.offset_sigma_m, keep, seen.world_variance_m2);
  }
  return estimate;
}

// The last frame's camera knows its place worst, and a closer look before it counts for more.
const std::array<SeenPatch, 3> kPatches{{{{0.3, -0.2, 0.7}, 0.010, 0.0004},
                                         {{1.1, 0.4, 0.7}, 0.005, 0.0009},
                                         {{-0.6, 0.9, 0.7}, 0.020, 0.0100}}};

TEST(PlaneEstimate, IsOffTheWorldAsTheCamerasThatSawItAreOnTheMeanByTheirWeights) {
  // By hand: heights weigh 10^4 / m^2 times 1, 4 and 1/4.
  EXPECT_NEAR(EstimateOf(kPatches, 1.0).world_variance_m2,
              (0.0004 + 4 * 0.0009 + 0.25 * 0.0100) / 5.25, 1e-12);
  // Old ones fade: 1/4, 2 and 1/4.
  EXPECT_NEAR(EstimateOf(kPatches, 0.5).world_variance_m2,
              (0.25 * 0.0004 + 2 * 0.0009 + 0.25 * 0.0100) / 2.5, 1e-12);
}

TEST(PlaneEstimate, IsKnownBetterByMoreFramesButNotInTheWorld) {
  std::array<SeenPatch, 3> alike = kPatches;
  for (SeenPatch& seen : alike) seen = kPatches[0];
  const PlaneEstimate many = EstimateOf(alike, 1.0);
  EXPECT_NEAR(many.world_variance_m2, 0.0004, 1e-12);
  EXPECT_NEAR(many.Covariance()(0, 0), 1e-4 / 3, 1e-9);
}

// Of a tilted plane far from the origin, where d hangs on the slopes.
TEST(PlaneEstimate, TellsTheHeightOfAnyOfItsPointsInTheWorld) {
  const Plane pi_w{Eigen::Vector3d(0.1, -0.2, 0.97).normalized(), -4.0};
  PlaneEstimate estimate;
  for (const SeenPatch& seen : kPatches) {
    AddObservation(estimate, pi_w, ProjectOnto(pi_w, seen.centroid_w), 0.02,
                   seen.offset_sigma_m, 1.0, seen.world_variance_m2);
  }
  EXPECT_EQ(estimate.frames, 3.0);
  const Eigen::Matrix4d told = estimate.WorldCovariance();
  for (const Eigen::Vector3d& seen_w :
       {Eigen::Vector3d(0.3, -0.2, 0.7), Eigen::Vector3d(8, 5, -3)}) {
    const Eigen::Vector3d x_w = ProjectOnto(pi_w, seen_w), lever = estimate.Lever(x_w);
    const double of_frames = lever.dot(estimate.Covariance() * lever);
    // Half of the error of one frame, three of which make a third of its variance.
    const double of_all = of_frames * (1.0 + 0.25 * 3.0) + estimate.world_variance_m2;
    EXPECT_NEAR(x_w.homogeneous().dot(told * x_w.homogeneous()), of_all, 1e-9 * of_all);
  }
  // The normal stays a unit vector.
  EXPECT_NEAR((told.topRows<3>().transpose() * pi_w.n).norm(), 0.0, 1e-12);
}

Plane PlaneAt(const Eigen::Vector3d& n, const Eigen::Vector3d& x_w) {
  return {n.normalized(), -n.normalized().dot(x_w)};
}

// The first observation sets the reference, and tells next to nothing of the plane.
TEST(PlaneEstimate, IsThePlaneOfWhatSawItWellHoweverFarOffItsReferenceLies) {
  const Plane truth = PlaneAt({0.2, -0.3, 0.9}, {0.4, 0.1, 1.3});
  for (const Eigen::Vector3d& poor_n :
       {Eigen::Vector3d(0.5, -0.3, 0.8), Eigen::Vector3d(0.0, -0.7, 0.9)}) {
    PlaneEstimate estimate;
    const Eigen::Vector3d first_w(0.3, 0.2, 1.2);
    AddObservation(estimate, PlaneAt(poor_n, first_w), first_w, 1e3, 1e3, 1.0);
    // Patches whose centroids do not lie on them to the last digit.
    for (const Eigen::Vector3d& seen_w :
         {Eigen::Vector3d(1.0, 0.3, 1.2), Eigen::Vector3d(-0.6, 0.8, 1.6),
          Eigen::Vector3d(0.1, -0.9, 1.0)})
      AddObservation(estimate, truth, seen_w, 0.01, 0.005, 1.0);
    EXPECT_LT(Angle(estimate.Mean().n, truth.n), 1e-6);
    EXPECT_NEAR(estimate.Mean().d, truth.d, 1e-6);
  }
}

TEST(PlaneEstimate, IsTheMeanOfHeightsAndOfSlopesByTheirWeightsOfWhichOldOnesFade) {
  constexpr double kApart_m = 0.01, kApart_rad = 0.001;
  for (const double keep : {1.0, 0.5}) {
    PlaneEstimate height, slope;
    const Eigen::Vector3d x_w(0, 0, 0.7);
    AddObservation(height, PlaneAt({0, 0, 1}, x_w), x_w, 0.02, 0.004, keep);
    AddObservation(slope, PlaneAt({0, 0, 1}, x_w), x_w, 0.02, 0.004, keep);
    // The second one is half as sure.
    AddObservation(height, PlaneAt({0, 0, 1}, {0, 0, 0.7 + kApart_m}), x_w, 0.04, 0.008, keep);
    AddObservation(slope, PlaneAt({kApart_rad, 0, 1}, x_w), x_w, 0.04, 0.008, keep);
    const double share = 1.0 / (1.0 + 4.0 * keep);
    EXPECT_NEAR(height.Mean().d, -(0.7 + share * kApart_m), 1e-9) << keep;
    EXPECT_NEAR(slope.Mean().n.x(), share * kApart_rad, 1e-8) << keep;
    EXPECT_NEAR(SignedDistance(slope.Mean(), x_w), 0.0, 1e-12) << keep;
    EXPECT_DOUBLE_EQ(height.frames, 1.0 + keep);
  }
}

TEST(PlaneEstimate, TakesNoSteepSlopeAndNoBackForTheSamePlane) {
  PlaneEstimate estimate;
  const Eigen::Vector3d x_w(0.1, 0.2, 0.7);
  AddObservation(estimate, PlaneAt({0, 0, 1}, x_w), x_w, 0.02, 0.005, 0.9);
  const Eigen::Matrix3d information = estimate.information;
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(1, 0, 0.5), Eigen::Vector3d(0, -1, 0)}) {
    AddObservation(estimate, PlaneAt(n, x_w), x_w, 0.02, 0.005, 0.9);
    EXPECT_EQ(estimate.information, information) << n.transpose();
    EXPECT_EQ(estimate.frames, 1.0);
  }
  AddObservation(estimate, PlaneAt({0.9, 0, 1}, x_w), x_w, 0.02, 0.005, 0.9);  // 42 degrees
  EXPECT_EQ(estimate.frames, 1.9);
}

}  // namespace
}  // namespace slam
