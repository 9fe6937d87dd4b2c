#include "slam/segment/measured_segments.h"

#include <gtest/gtest.h>

#include <vector>

#include "slam/geometry/camera.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

PlaneExtractionConfig AtAnyAngle() {
  PlaneExtractionConfig config;
  config.max_angle_sigma_rad = 1.0;
  return config;
}

/// The segments of a wall of which parts have labels 0, 1, ...
/// @param scatter_sigmas  of the wall's pixels, alternately before and behind it
std::vector<Segment> KeepParts(const std::vector<cv::Rect>& parts, const SensorModel& sensor,
                               const Camera& camera = {}, double scatter_sigmas = 0.0,
                               const PlaneExtractionConfig& config = AtAnyAngle()) {
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  const double off_m = scatter_sigmas * sensor.noise.Sigma(1.0);
  for (int v = 0; v < depth_m.rows; ++v)
    for (int u = 0; u < depth_m.cols; ++u)
      depth_m(v, u) += static_cast<float>((u + v) % 2 == 0 ? off_m : -off_m);
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), sensor.noise, 10.0);
  LabelImage labels(grid.q.size(), kNoLabel);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (int v = parts[k].y; v < parts[k].br().y; ++v)
      for (int u = parts[k].x; u < parts[k].br().x; ++u)
        labels[static_cast<std::size_t>(grid.Index(u, v))] = static_cast<std::int16_t>(k);
  }
  PartSegments segments{{}, SumLabels(grid, labels, static_cast<int>(parts.size()))};
  FindRuns(labels, grid.width, grid.height, segments.runs);
  return KeepMeasured(segments, sensor, config);
}

TEST(MeasuredSegments, AreWiderThanThePixelsThatAreMeasuredTogether) {
  // Errors of the first Kinect are shared by 4 x 4 pixels, those of a D435 by 6 x 6.
  const std::vector<cv::Rect> strips = {{50, 50, 400, 3}, {50, 100, 400, 5}, {50, 150, 7, 300}};
  const std::vector<Segment> kinect1 = KeepParts(strips, ModelOf(DepthSensor::kKinect1));
  ASSERT_EQ(kinect1.size(), 2u);
  EXPECT_EQ(kinect1[0].id, 2);
  EXPECT_EQ(kinect1[1].id, 1);
  const std::vector<Segment> d435 = KeepParts(strips, ModelOf(DepthSensor::kD435));
  ASSERT_EQ(d435.size(), 1u);
  EXPECT_EQ(d435[0].id, 2);
  // Time of flight measures each pixel by itself: a narrow face is one.
  EXPECT_EQ(KeepParts(strips, ModelOf(DepthSensor::kAzure)).size(), 3u);
}

TEST(MeasuredSegments, AreCutByTheImageWithoutBecomingNarrow) {
  EXPECT_EQ(KeepParts({{0, 0, 640, 3}}, {}).size(), 1u);
}

TEST(MeasuredSegments, AreTheLargestFirstAndNotTooSmall) {
  const std::vector<Segment> kept =
      KeepParts({{50, 50, 20, 30}, {100, 100, 20, 29}, {200, 200, 40, 40}}, {});
  ASSERT_EQ(kept.size(), 2u);
  EXPECT_EQ(kept[0].id, 2);
  EXPECT_EQ(kept[1].id, 0);
}

TEST(MeasuredSegments, AreLessSureByTheFactorByWhichTheyScatterMoreThanNoise) {
  const auto sigmas = [](double scatter_sigmas) {
    return KeepParts({{200, 200, 100, 100}}, {}, {}, scatter_sigmas).at(0).sigmas;
  };
  const PlaneSigmas usual = sigmas(0.5), rough = sigmas(3.0);
  EXPECT_NEAR(rough.offset_m / usual.offset_m, 3.0, 0.05);
  EXPECT_NEAR(rough.angle_rad / usual.angle_rad, 3.0, 0.05);
}

TEST(MeasuredSegments, TellWellEnoughHowTheyAreTurned) {
  const std::vector<cv::Rect> square{{200, 200, 60, 60}};
  const double sigma_rad = KeepParts(square, {}).at(0).sigmas.angle_rad;
  PlaneExtractionConfig config;
  for (const double times : {0.99, 1.01}) {
    config.max_angle_sigma_rad = times * sigma_rad;
    EXPECT_EQ(KeepParts(square, {}, {}, 0.0, config).size(), times > 1 ? 1u : 0u);
  }
}

// Their numbers are written as single bytes, of which 0 is none.
TEST(MeasuredSegments, AreNoMoreThanALabelImageHasRoomForAndTheSmallestAreLeftOut) {
  std::vector<cv::Rect> parts;
  for (int k = 0; k < 300; ++k)
    parts.push_back({25 * (k % 25), 40 * (k / 25), 20, k % 50 < 8 ? 30 : 35});
  PlaneExtractionConfig config = AtAnyAngle();
  config.min_share = 0.0;
  const std::vector<Segment> kept = KeepParts(parts, {}, {}, 0.0, config);
  ASSERT_EQ(kept.size(), 254u);
  for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(kept[k].sums.n, k < 252 ? 700 : 600);
}

TEST(MeasuredSegments, AreTheSameShareOfASmallImage) {
  Camera half;
  half.fx /= 2, half.fy /= 2, half.cx /= 2, half.cy /= 2, half.width /= 2, half.height /= 2;
  const std::vector<Segment> kept = KeepParts({{50, 50, 10, 14}, {100, 100, 10, 15}}, {}, half);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].id, 1);
}

}  // namespace
}  // namespace slam
