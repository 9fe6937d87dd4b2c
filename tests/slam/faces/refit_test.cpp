#include "slam/faces/refit.h"

#include <gtest/gtest.h>

#include "slam/geometry/camera.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const Plane kTruth{Eigen::Vector3d(0, -0.6, -0.8), 0.8};

/// Points of a slanted plane on a grid; the first `outliers` of them 5 cm nearer.
FramePlane SlantedPlane(int outliers, double times_as_far = 1.0) {
  FramePlane plane;
  plane.pi_c = {kTruth.n, kTruth.d * times_as_far};
  const Camera camera;
  int k = 0;
  for (int v = 150; v < 330; v += 10) {
    for (int u = 220; u < 420; u += 10, ++k) {
      const Eigen::Vector3d ray = camera.Backproject({u, v}, 1.0);
      const double z = -plane.pi_c.d / kTruth.n.dot(ray) - (k < outliers ? 0.05 : 0.0);
      plane.points_c.push_back(ray * z);
      plane.centroid_c += ray * z;
    }
  }
  plane.centroid_c /= k;
  return plane;
}

TEST(Refit, ReturnsThePlaneOfItsPoints) {
  for (const RefitMethod method :
       {RefitMethod::kPcl, RefitMethod::kWeighted, RefitMethod::kBest}) {
    FramePlane plane = SlantedPlane(0);
    RefitPlane(plane, {}, {.method = method});
    EXPECT_THAT(plane.pi_c, PlaneNear(kTruth, 1e-5, 1e-5));  // PCL computes in float
    EXPECT_EQ(plane.inlier_ratio, 1.0);
  }
}

TEST(Refit, IsNotPulledByOutliersAndCountsThem) {
  FramePlane plane = SlantedPlane(90);  // a quarter of 360
  plane.pi_c = {Eigen::Vector3d(0, -0.55, -0.835).normalized(),
                0.79};  // what they had made of it
  RefitPlane(plane, {}, {});
  EXPECT_THAT(plane.pi_c, PlaneNear(kTruth, 1e-5, 1e-5));
  EXPECT_NEAR(plane.inlier_ratio, 0.75, 1e-12);
  EXPECT_EQ(plane.points_c.size(), 270u);
  EXPECT_NEAR(SignedDistance(plane.pi_c, plane.centroid_c), 0.0, 1e-12) << "moved onto it";
}

// A wave of the bend's size is what a flat thing looks like; to a sensor that does not bend it is not
// flat.
TEST(Refit, CountsAsFlatWhatTheSensorBends) {
  for (const double times_as_far : {0.5, 1.0, 4.0}) {
    const auto bent = [&](double bends) {
      FramePlane plane = SlantedPlane(0, times_as_far);
      for (std::size_t k = 0; k < plane.points_c.size(); ++k)
        plane.points_c[k] *= 1.0 + bends * kKinectBend * ((k / 5) % 2 == 0 ? 1.0 : -1.0);
      return plane;
    };
    const RefitConfig own_fit{.min_improvement_chi2 = 1e9};
    SensorModel exact;  // but for the bend
    exact.noise = {.floor_m = 1e-5, .quadratic_per_m = 0.0, .grazing_m = 0.0};
    FramePlane by_kinect = bent(2.0), too_much = bent(4.0), by_flat = bent(2.0);
    RefitPlane(by_kinect, exact, own_fit);
    EXPECT_GT(by_kinect.inlier_ratio, 0.95) << times_as_far;
    RefitPlane(too_much, exact, own_fit);
    EXPECT_LT(too_much.inlier_ratio, 0.05) << times_as_far;
    exact.bend_ratio = 0.0;
    RefitPlane(by_flat, exact, own_fit);
    EXPECT_LT(by_flat.inlier_ratio, 0.05) << times_as_far;
  }
}

TEST(Refit, DropsEdgePointsOffThePlaneAndPutsTheOthersOnIt) {
  FramePlane plane = SlantedPlane(0);
  const Eigen::Vector3d on = plane.points_c.front();
  plane.edge_points = {{on * 1.001, {220, 150}, EdgeKind::kSurface},
                       {on * 1.2, {240, 150}, EdgeKind::kSurface}};
  RefitPlane(plane, {}, {});
  ASSERT_EQ(plane.edge_points.size(), 1u);
  EXPECT_NEAR(SignedDistance(plane.pi_c, plane.edge_points[0].p_c), 0.0, 1e-9);
  EXPECT_EQ(plane.box_px.max, Eigen::Vector2d(220, 150));
}

TEST(Refit, SaysThatNothingSupportsAPlaneWithoutPoints) {
  FramePlane plane;
  plane.pi_c = kTruth, plane.inlier_ratio = 1.0;
  RefitPlane(plane, {}, {});
  EXPECT_EQ(plane.inlier_ratio, 0.0);
  EXPECT_EQ(plane.pi_c.d, kTruth.d);
}

TEST(Refit, SurvivesPointsOnALine) {
  FramePlane plane = SlantedPlane(0);
  plane.points_c.resize(15);  // one row of the grid
  RefitPlane(plane, {}, {});
  EXPECT_TRUE(plane.pi_c.n.allFinite());
}

TEST(Refit, UnderNoiseTheDefaultIsAtLeastAsGoodAsPclAlone) {
  // 30 noisy views of a desk: mean squared offset at the centre, paired. Fixed seeds.
  const Camera camera;
  const cv::Mat2d rays = PixelRays(camera);
  const Pose T_cw = closed_form::LookAt({0.1, -0.5, 0.6}, {0, 0, 0});
  const Plane truth = Transform(T_cw, {Eigen::Vector3d::UnitZ(), 0.0});
  const cv::Mat1f exact = closed_form::Render(closed_form::Desk(), camera, T_cw).depth_m;
  double pcl = 0, weighted = 0, best = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Frame frame = closed_form::MakeFrame(closed_form::AddKinectNoise(exact, seed));
    ExtractPlanes(frame, rays, {});
    const auto error2 = [&](RefitMethod method) {
      FramePlane plane = frame.planes.at(0);
      RefitPlane(plane, {}, {.method = method});
      return std::pow(SignedDistance(truth, plane.centroid_c), 2) / 30;
    };
    pcl += error2(RefitMethod::kPcl);
    weighted += error2(RefitMethod::kWeighted);
    best += error2(RefitMethod::kBest);
  }
  std::printf("rms offset: PCL %.3f mm, weighted %.3f mm, best %.3f mm\n", 1e3 * std::sqrt(pcl),
              1e3 * std::sqrt(weighted), 1e3 * std::sqrt(best));
  EXPECT_LE(best, pcl);
  EXPECT_LE(weighted, pcl);
}

}  // namespace
}  // namespace slam
