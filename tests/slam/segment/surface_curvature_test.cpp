#include "slam/segment/surface_curvature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/geometry/plane_sums.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// The middle of what a Kinect sees.
Camera MiddleOfAKinect(int width, int height) {
  Camera camera;
  camera.width = width, camera.height = height;
  camera.cx = 0.5 * (width - 1), camera.cy = 0.5 * (height - 1);
  return camera;
}

const Camera kCamera = MiddleOfAKinect(110, 100), kWide = MiddleOfAKinect(310, 210);
constexpr double kAway_m = 0.8;
constexpr std::uint8_t kLabel = 3;

/// A cylinder whose nearest line is kAway_m in front of the camera, its axis across the view and turned by
/// `turn_rad`, seen from outside or, `hollow`, a trough seen from inside.
cv::Mat1f CylinderDepth(const Camera& camera, double radius_m, double turn_rad, bool hollow) {
  const Eigen::Vector3d axis(std::cos(turn_rad), std::sin(turn_rad), 0.0);
  const Eigen::Vector3d middle(0.0, 0.0, kAway_m + (hollow ? -radius_m : radius_m));
  cv::Mat1f depth_m(camera.height, camera.width, 0.0f);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      // |(z ray - middle) off the axis| = radius.
      const Eigen::Vector3d ray = camera.Backproject({u, v}, 1.0);
      const Eigen::Vector3d r = ray - ray.dot(axis) * axis, m = middle;
      const double a = r.dot(r), b = r.dot(m), c = m.dot(m) - radius_m * radius_m;
      const double root = b * b - a * c;
      if (root < 0) continue;
      depth_m(v, u) = static_cast<float>((b + (hollow ? 1 : -1) * std::sqrt(root)) / a);
    }
  }
  return depth_m;
}

/// A plane through (0, 0, kAway_m).
cv::Mat1f PlaneDepth(const Camera& camera, double incidence_rad) {
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double x = camera.Backproject({u, v}, 1.0).x();
      depth_m(v, u) = static_cast<float>(kAway_m / (1.0 - std::tan(incidence_rad) * x));
    }
  }
  return depth_m;
}

/// Of a segment of that size in the middle of the image, as the plane that fits it best.
SurfaceCurvature CurvatureOf(const cv::Mat1f& depth_m, cv::Size size,
                             const DepthNoise& noise = {}) {
  const Camera camera = MiddleOfAKinect(depth_m.cols, depth_m.rows);
  const cv::Rect bounds(
      {camera.width / 2 - size.width / 2, camera.height / 2 - size.height / 2}, size);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), noise, 10.0);
  cv::Mat1b labels(camera.height, camera.width, std::uint8_t{kLabel + 1});
  labels(bounds) = kLabel;
  PlaneSums sums;
  FramePlane plane;
  plane.index = kLabel - 1;
  for (int v = bounds.y; v < bounds.y + bounds.height; ++v) {
    for (int u = bounds.x; u < bounds.x + bounds.width; ++u) {
      const auto z = static_cast<double>(depth_m(v, u));
      const Eigen::Vector3d x_c = camera.Backproject({u, v}, z);
      sums.Add(x_c.x() / z, x_c.y() / z, 1.0 / z, std::pow(z * z / noise.Sigma(z), 2));
      plane.centroid_c += x_c / size.area();
    }
  }
  plane.pixel_count = size.area();
  plane.area_m2 = size.area() * std::pow(plane.centroid_c.z() / camera.fx, 2);
  if (const auto fit = Fit(sums)) plane.pi_c = fit->plane.Hessian();
  // The segment's row and column beyond its bounds are another's.
  return MeasureCurvature(grid, labels,
                          {bounds.x - 1, bounds.y - 1, bounds.width + 2, bounds.height + 2},
                          plane, noise);
}

TEST(SurfaceCurvature, OfACylinderIsOneOverItsRadiusHoweverItLies) {
  for (const double radius_m : {0.08, 0.2, 0.5}) {
    for (const double turn_deg : {0.0, 20.0, 45.0, 90.0, 130.0}) {
      for (const bool hollow : {false, true}) {
        SCOPED_TRACE(testing::Message() << radius_m << " m, " << turn_deg << ", " << hollow);
        const cv::Mat1f depth_m =
            CylinderDepth(kCamera, radius_m, turn_deg * M_PI / 180, hollow);
        EXPECT_NEAR(CurvatureOf(depth_m, {40, 40}).per_m * radius_m, 1.0, 0.1);
      }
    }
  }
}

TEST(SurfaceCurvature, OfALargeSurfaceIsThatOfSomeOfItsPixels) {
  const cv::Mat1f depth_m = CylinderDepth(kWide, 2.0, 0.3, false);
  EXPECT_NEAR(CurvatureOf(depth_m, {300, 200}).per_m, 0.5, 0.05);
}

/// How many of sixty noisy images of a surface show it surely curved.
int SurelyCurved(const cv::Mat1f& depth_m, cv::Size size) {
  int surely = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto noisy = closed_form::AddKinectNoise(depth_m, seed);
    surely += CurvatureOf(noisy, size).Surely_per_m() > 0 ? 1 : 0;
  }
  return surely;
}

TEST(SurfaceCurvature, TellsACupFromAFlatThingThroughNoise) {
  EXPECT_GE(SurelyCurved(CylinderDepth(kCamera, 0.04, 0.7, false), {34, 34}), 55);
  for (const double incidence_deg : {0.0, 50.0}) {
    const cv::Mat1f depth_m = PlaneDepth(kCamera, incidence_deg * M_PI / 180);
    EXPECT_LE(SurelyCurved(depth_m, {34, 34}), 1) << incidence_deg;
    EXPECT_LE(SurelyCurved(depth_m, {12, 80}), 1) << incidence_deg;
  }
}

TEST(SurfaceCurvature, IsAsUncertainAsNoiseThatPixelsShare) {
  const cv::Mat1f depth_m = PlaneDepth(kCamera, 0.4);
  DepthNoise alone, shared;
  alone.correlated_px = 16.0, shared.correlated_px = 64.0;
  EXPECT_NEAR(CurvatureOf(depth_m, {60, 60}, shared).sigma_per_m,
              2 * CurvatureOf(depth_m, {60, 60}, alone).sigma_per_m, 1e-9);
}

// Nguyen, Izadi and Lovell 2012: at 70 degrees from the front a first Kinect's noise is 1.9 times as
// large at 0.8 m, 1.5 + 1.4 mm; at 20 degrees it is as large.
TEST(SurfaceCurvature, IsLessCertainOfASurfaceSeenAtASlant) {
  DepthNoise even;
  even.grazing_m = 0.0;
  for (const double incidence_deg : {20.0, 70.0}) {
    const cv::Mat1f depth_m = PlaneDepth(kCamera, incidence_deg * M_PI / 180);
    EXPECT_NEAR(CurvatureOf(depth_m, {20, 20}).sigma_per_m /
                    CurvatureOf(depth_m, {20, 20}, even).sigma_per_m,
                incidence_deg > 45 ? 1.91 : 1.0, 0.08)
        << incidence_deg;
  }
}

TEST(SurfaceCurvature, IsNotToldByAFewPixelsOrOneRow) {
  const cv::Mat1f depth_m = CylinderDepth(kCamera, 0.1, 0.0, false);
  EXPECT_EQ(CurvatureOf(depth_m, {5, 5}).per_m, 0.0);
  EXPECT_LE(CurvatureOf(depth_m, {60, 1}).Surely_per_m(), 0.0);
}

}  // namespace
}  // namespace slam
