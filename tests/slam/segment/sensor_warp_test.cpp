#include "slam/segment/sensor_warp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slam/geometry/camera.h"
#include "slam/segment/boundary_shares.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// A surface 1 m away that rises to the right of the middle column by `crease_deg`, seen with
/// noise by a sensor that bends it by waves of `bend_m`.
cv::Mat1f WarpedDepth(const Camera& camera, double crease_deg, double bend_m,
                      std::uint64_t seed) {
  const cv::Mat2d rays = PixelRays(camera);
  cv::Mat1f depth_m(camera.height, camera.width);
  const double slope = std::tan(crease_deg * std::numbers::pi / 180.0);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double right = std::max(rays(v, u)[0] - rays(0, depth_m.cols / 2)[0], 0.0);
      const double wave = std::sin(u / 60.0) * std::cos(v / 50.0);
      depth_m(v, u) = static_cast<float>(1.0 - slope * right + bend_m * wave);
    }
  }
  return closed_form::AddKinectNoise(depth_m, seed);
}

double WarpOf(const cv::Mat1f& depth_m, const Camera& camera,
              const PlaneExtractionConfig& config = {}) {
  const SensorModel sensor;
  const DepthGrid grid =
      MakeDepthGrid(depth_m, PixelRays(camera), sensor.noise, sensor.max_depth_m);
  BlockClustering clustering;
  const BlockClusters& clusters =
      clustering.Cluster(grid, {}, config.block_px, sensor.noise, config.coarse);
  return WarpMeasurement().Measure(clusters, clustering.SumsOfBlocks(), sensor.noise, config);
}

/// Share of the image that the largest segment holds.
double Largest(const cv::Mat1f& depth_m, const Camera& camera,
               const PlaneExtractionConfig& config = {}) {
  Frame frame = closed_form::MakeFrame(depth_m);
  ExtractPlanes(frame, camera, PixelRays(camera), config);
  return frame.planes.empty() ? 0.0
                              : static_cast<double>(frame.planes[0].pixel_count) /
                                    static_cast<double>(depth_m.total());
}

TEST(SensorWarp, IsNoneOfAFlatSensorWhateverItSees) {
  const Camera camera;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    EXPECT_EQ(WarpOf(WarpedDepth(camera, 0.0, 0.0, seed), camera), 0.0) << seed;
    EXPECT_EQ(WarpOf(WarpedDepth(camera, 2.0, 0.0, seed), camera), 0.0) << seed;
  }
  closed_form::World world = closed_form::Desk();
  closed_form::PutOnDesk(world, 0.0, 0.0, {0.15, 0.22, 0.004}, 0.3, "book");
  const closed_form::View view =
      closed_form::Render(world, camera, closed_form::LookAt({0.05, -0.7, 0.7}, {0, 0, 0}));
  EXPECT_EQ(WarpOf(closed_form::AddKinectNoise(view.depth_m, 1), camera), 0.0);
}

TEST(SensorWarp, IsSeenWhereTheSensorBendsAndIsCutOff) {
  const Camera camera;
  for (const double bend_m : {0.001, 0.003, 0.008}) {
    EXPECT_GT(WarpOf(WarpedDepth(camera, 0.0, bend_m, 1), camera), 0.1) << bend_m;
  }
  PlaneExtractionConfig config;
  config.max_warp_sigmas = 0.05;
  EXPECT_EQ(WarpOf(WarpedDepth(camera, 0.0, 0.006, 1), camera, config), 0.05);
}

TEST(SensorWarp, OfTooFewBlocksIsNone) {
  Camera camera;
  camera.width = 64, camera.height = 32;
  EXPECT_EQ(WarpOf(WarpedDepth(camera, 0.0, 0.006, 1), camera), 0.0);
}

TEST(SensorWarp, WidensNoBoundOfAFlatSensor) {
  const PlaneExtractionConfig config, flat = AllowWarp(config, 0.0);
  EXPECT_EQ(flat.coarse.model_error_sigmas, config.coarse.model_error_sigmas);
  EXPECT_EQ(flat.fine.model_error_sigmas, config.fine.model_error_sigmas);
  EXPECT_EQ(flat.max_bend_sigmas, config.max_bend_sigmas);
  EXPECT_EQ(flat.max_hidden_gap_sigmas, config.max_hidden_gap_sigmas);
  EXPECT_EQ(flat.unsure_side_sigmas, config.unsure_side_sigmas);
  EXPECT_GT(AllowWarp(config, 0.1).max_bend_sigmas, config.max_bend_sigmas);
}

TEST(SensorWarp, LeavesMostOfABentSurfaceWhole) {
  const Camera camera;
  PlaneExtractionConfig rigid;
  rigid.max_warp_sigmas = 0.0;
  double allowed = 0.0, cut = 0.0;
  for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
    const cv::Mat1f depth_m = WarpedDepth(camera, 0.0, 0.008, seed);  // 4.3 sigmas
    allowed += 0.25 * Largest(depth_m, camera), cut += 0.25 * Largest(depth_m, camera, rigid);
  }
  EXPECT_GT(allowed, 0.75);
  EXPECT_LT(cut, 0.5);
}

TEST(SensorWarp, DoesNotJoinPlatesThatMeetInACrease) {
  const Camera camera;
  for (const std::uint64_t seed : {1u, 2u}) {
    EXPECT_LT(Largest(WarpedDepth(camera, 2.0, 0.0, seed), camera), 0.55) << seed;
    EXPECT_LT(Largest(WarpedDepth(camera, 8.0, 0.003, seed), camera), 0.55) << seed;
  }
}

/// The share at the middle column of what is left and right of it.
BoundaryShare ShareInTheMiddle(const cv::Mat1f& depth_m, const Camera& camera) {
  const DepthNoise noise;
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), noise, 10.0);
  LabelImage labels(depth_m.total());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = static_cast<int>(i) % grid.width < grid.width / 2 ? 0 : 1;
  }
  std::vector<LabelPlane> planes;
  for (const PlaneSums& side : SumLabels(grid, labels, 2))
    planes.push_back({Fit(side)->plane, 1.0});
  LabelRuns runs;
  FindRuns(labels, grid.width, grid.height, runs);
  LabelPairs<BoundaryStrips> strips;
  BoundaryShares shares;
  MeasureShares(grid, labels, runs, planes, noise, strips, shares);
  return shares.Sorted().at(0).value;
}

TEST(BoundaryShares, AreAllOfACreaseAndOfAStep) {
  const Camera camera;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const BoundaryShare crease = ShareInTheMiddle(WarpedDepth(camera, 3.0, 0.0, seed), camera);
    EXPECT_NEAR(crease.share, 1.0, 3.0 * crease.sigma) << seed;
    EXPECT_TRUE(crease.IsCrease()) << seed;
  }
  cv::Mat1f step = WarpedDepth(camera, 0.0, 0.0, 4);
  step(cv::Rect(0, 0, camera.width / 2, camera.height)) -= 0.008f;
  EXPECT_TRUE(ShareInTheMiddle(step, camera).IsCrease());
}

TEST(BoundaryShares, AreAsSmallAsTheStripsInAnEvenBend) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width);
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double x = (u - 0.5 * camera.width) / (0.5 * camera.width);
      depth_m(v, u) = static_cast<float>(1.0 + 0.03 * x * x);
    }
  }
  // A strip is 40 of 320 pixels wide: an eighth.
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const BoundaryShare bend =
        ShareInTheMiddle(closed_form::AddKinectNoise(depth_m, seed), camera);
    EXPECT_NEAR(bend.share, 0.125, 3.0 * bend.sigma + 0.05) << seed;
    EXPECT_FALSE(bend.IsCrease()) << seed;
  }
}

}  // namespace
}  // namespace slam
