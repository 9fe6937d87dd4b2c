#include "slam/faces/bend_meter.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/cameras.h"
#include "tests/support/plane_world.h"

namespace slam {
namespace {

constexpr double kWall_m = 1.5;

/// A wall that fills the image. `bend(u, v)` lengthens its depth, as a share of it.
template <typename Bend>
Frame Wall(const Camera& camera, const DepthNoise& noise, int index, const Bend& bend) {
  Frame frame;
  frame.index = index;
  frame.depth_m = cv::Mat1f(camera.height, camera.width);
  frame.plane_labels = cv::Mat1b(camera.height, camera.width, std::uint8_t{1});
  Random random{7, static_cast<std::uint64_t>(index)};
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double z = kWall_m * (1.0 + bend(u, v)) + noise.Sigma(kWall_m) * Normal(random);
      frame.depth_m(v, u) = static_cast<float>(z);
    }
  }
  FramePlane plane;
  plane.pi_c = {{0, 0, -1}, kWall_m};
  plane.centroid_c = {0, 0, kWall_m};
  plane.pixel_count = camera.width * camera.height;
  frame.planes.push_back(plane);
  return frame;
}

TEST(BendMeter, FindsThatAFlatSensorBendsNothing) {
  const Camera camera;
  const SensorModel sensor;
  BendMeter meter(PixelRays(camera), sensor);
  EXPECT_DOUBLE_EQ(meter.ratio(), sensor.bend_ratio);
  for (int k = 0; k < 150; ++k) {
    Frame frame = Wall(camera, sensor.noise, k % 3, [](int, int) { return 0.0; });
    meter.Measure(0.0, frame);
  }
  EXPECT_LT(meter.ratio(), 0.2 * sensor.bend_ratio);
}

TEST(BendMeter, BelievesTheFirstFrameMoreThanWhatSensorsUsuallyDo) {
  const Camera camera;
  const SensorModel sensor;
  BendMeter meter(PixelRays(camera), sensor);
  Frame frame = Wall(camera, sensor.noise, 0, [](int, int) { return 0.0; });
  meter.Measure(0.0, frame);
  EXPECT_LT(meter.ratio(), 0.5 * sensor.bend_ratio);
  EXPECT_DOUBLE_EQ(frame.bend_ratio, meter.ratio());
}

TEST(BendMeter, KeepsWhatPlanesDoNotShowOfATimeOfFlight) {
  const Camera camera;
  const SensorModel sensor = ModelOf(DepthSensor::kAzure);
  BendMeter meter(PixelRays(camera), sensor);
  for (int k = 0; k < 3; ++k) {
    Frame frame = Wall(camera, sensor.noise, k, [](int, int) { return 0.0; });
    meter.Measure(0.0, frame);
    EXPECT_DOUBLE_EQ(frame.bend_ratio, sensor.bend_ratio);
    // It lifts a wall as a whole, however large that is.
    const double offset_m = frame.planes[0].bend_offset_sigma_m;
    EXPECT_GE(offset_m, sensor.unseen_ratio * kWall_m);
    EXPECT_LT(offset_m, 1.1 * sensor.unseen_ratio * kWall_m);
  }
  EXPECT_LT(meter.ratio(), 0.5 * sensor.bend_ratio);
}

TEST(BendMeter, CountsWhatAWarpLeavesThoughPlanesDoNotShowIt) {
  const Camera camera;
  const SensorModel sensor;
  BendMeter meter(PixelRays(camera), sensor), without(PixelRays(camera), sensor);
  constexpr double kLeft = 0.002;
  for (int k = 0; k < 3; ++k) {
    Frame frame = Wall(camera, sensor.noise, k, [](int, int) { return 0.0; });
    Frame same = frame;
    meter.Measure(kLeft, frame);
    without.Measure(0.0, same);
    ASSERT_LT(meter.ratio(), kLeft);
    EXPECT_DOUBLE_EQ(frame.bend_ratio, kLeft);
    const FramePlane &plane = frame.planes[0], &sharper = same.planes[0];
    const double times = kLeft / meter.ratio();
    EXPECT_NEAR(plane.bend_offset_sigma_m, times * sharper.bend_offset_sigma_m, 1e-12);
    EXPECT_NEAR(plane.bend_angle_sigma_rad, times * sharper.bend_angle_sigma_rad, 1e-12);
  }
}

TEST(BendMeter, FindsByHowMuchASensorBends) {
  // Waves of 220 columns, as of a first Kinect, of half and of twice its height.
  const Camera camera;
  const SensorModel sensor;
  for (const double rms : {0.5 * kKinectBend, 2.0 * kKinectBend}) {
    BendMeter meter(PixelRays(camera), sensor);
    for (int k = 0; k < 150; ++k) {
      Frame frame = Wall(camera, sensor.noise, k % 3, [&](int u, int v) {
        return rms * std::sqrt(2.0) * std::cos(2 * M_PI * (u + 0.2 * v) / 220.0);
      });
      meter.Measure(0.0, frame);
    }
    EXPECT_NEAR(meter.ratio(), rms, 0.15 * rms);
  }
}

TEST(BendMeter, FindsTheSameBendInAnImageOfAnyWidth) {
  SensorModel sensor;
  sensor.noise = {.floor_m = 1e-6, .quadratic_per_m = 0.0, .grazing_m = 0.0};
  // Waves a tenth of the image long: what a cell averages depends on how much it sees of one.
  const auto measured = [&](int width) {
    const Camera camera = CameraOfSize(width, 3 * width / 4);
    Frame frame = Wall(camera, sensor.noise, 0, [&](int u, int v) {
      return 0.01 * std::cos(2 * M_PI * 10 * (u + 0.5 + 0.2 * (v + 0.5)) / width);
    });
    BendMeter meter(PixelRays(camera), sensor);
    meter.Measure(0.0, frame);
    return meter.ratio();
  };
  const double usual = measured(640);
  for (const int width : {320, 1280})
    EXPECT_NEAR(measured(width), usual, 0.03 * usual) << width;
}

TEST(BendMeter, StaysWithWhatIsKnownOfTheSensorUntilALargePlaneIsSeen) {
  const Camera camera;
  const SensorModel sensor;
  BendMeter meter(PixelRays(camera), sensor);
  Frame frame = Wall(camera, sensor.noise, 0, [](int, int) { return 0.05; });
  cv::Mat1b small(frame.plane_labels.size(), std::uint8_t{0});
  small(cv::Rect(200, 200, 80, 60)) = 1;
  frame.plane_labels = small;
  frame.planes[0].pixel_count = 80 * 60;
  meter.Measure(0.0, frame);
  EXPECT_DOUBLE_EQ(meter.ratio(), sensor.bend_ratio);
  EXPECT_GT(frame.planes[0].bend_offset_sigma_m, 0.5 * sensor.bend_ratio * kWall_m);
}

TEST(BendMeter, StaysWithWhatIsKnownOfTheSensorInFramesWithoutPlanes) {
  const Camera camera;
  const SensorModel sensor;
  BendMeter meter(PixelRays(camera), sensor);
  Frame frame;
  meter.Measure(0.0, frame);
  EXPECT_DOUBLE_EQ(frame.bend_ratio, sensor.bend_ratio);
}

/// What a plane takes up of random bends: standard deviations of its height and one slope, over
/// many draws of a Gaussian field with correlation exp(-r^2 / 2 L^2), by least squares.
BendSigmas Drawn(double width_rad, double ratio) {
  constexpr int kDraws = 400, kWaves = 60, kSide = 24;
  Random random{3};
  double height2 = 0.0, slope2 = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Eigen::Vector3d> waves;  // wave vector and phase
    for (int k = 0; k < kWaves; ++k) {
      waves.emplace_back(Normal(random) / kBendLength_rad, Normal(random) / kBendLength_rad,
                         2 * M_PI * random.Uniform());
    }
    double sum = 0.0, moment = 0.0, spread = 0.0;
    for (int i = 0; i < kSide; ++i) {
      for (int k = 0; k < kSide; ++k) {
        const double x = width_rad * ((i + 0.5) / kSide - 0.5);
        const double y = width_rad * ((k + 0.5) / kSide - 0.5);
        double bend = 0.0;
        for (const auto& wave : waves) bend += std::cos(wave.x() * x + wave.y() * y + wave.z());
        bend *= ratio * std::sqrt(2.0 / kWaves);
        sum += bend, moment += bend * x, spread += x * x;
      }
    }
    height2 += std::pow(sum / (kSide * kSide), 2);
    slope2 += std::pow(moment / spread, 2);
  }
  return {std::sqrt(height2 / kDraws), std::sqrt(slope2 / kDraws)};
}

TEST(SigmasOfBend, AreThoseOfPlanesFittedToRandomBends) {
  for (const double lengths : {0.3, 1.0, 3.0, 8.0}) {
    SCOPED_TRACE(lengths);
    const double width_rad = lengths * kBendLength_rad;
    const BendSigmas drawn = Drawn(width_rad, 0.01);
    const BendSigmas ours = SigmasOfBend(0.01, 1.0, width_rad * width_rad);
    EXPECT_NEAR(ours.offset_m / drawn.offset_m, 1.0, 0.35);
    EXPECT_NEAR(ours.angle_rad / drawn.angle_rad, 1.0, 0.35);
  }
}

TEST(SigmasOfBend, GrowWithTheBendAndTheOffsetWithTheDistance) {
  const BendSigmas one = SigmasOfBend(0.003, 1.0, 0.02), far = SigmasOfBend(0.003, 2.0, 0.02);
  const BendSigmas twice = SigmasOfBend(0.006, 1.0, 0.02);
  EXPECT_DOUBLE_EQ(far.offset_m, 2 * one.offset_m);
  EXPECT_DOUBLE_EQ(far.angle_rad, one.angle_rad);
  EXPECT_DOUBLE_EQ(twice.offset_m, 2 * one.offset_m);
  EXPECT_DOUBLE_EQ(twice.angle_rad, 2 * one.angle_rad);
}

}  // namespace
}  // namespace slam
