#include "slam/faces/bend_meter.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// A plane through (0, 0, z), seen at this incidence there.
Plane SlantedPlane(double z_m, double incidence_rad) {
  const Eigen::Vector3d n(std::sin(incidence_rad), 0.0, -std::cos(incidence_rad));
  return {n, n.z() * -z_m};
}

/// What a plane through (0, 0, 1 m) takes up of random bends: standard deviations of its height and of
/// the larger of its two slopes, over many draws of a Gaussian field with correlation
/// exp(-r^2 / 2 L^2), by least squares over the points that were measured.
BendSigmas Drawn(double width_rad, double ratio, double incidence_rad) {
  constexpr int kDraws = 400, kWaves = 60, kSide = 24;
  const Plane pi_c = SlantedPlane(1.0, incidence_rad);
  const Eigen::Matrix<double, 3, 2> axes = TangentBasis(pi_c.n);
  Random random{3};
  Eigen::Vector3d squares = Eigen::Vector3d::Zero();  // of the height and both slopes
  for (int draw = 0; draw < kDraws; ++draw) {
    std::vector<Eigen::Vector3d> waves;  // wave vector and phase
    for (int k = 0; k < kWaves; ++k) {
      waves.emplace_back(Normal(random) / kBendLength_rad, Normal(random) / kBendLength_rad,
                         2 * M_PI * random.Uniform());
    }
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    Eigen::Vector3d moments = Eigen::Vector3d::Zero();
    for (int i = 0; i < kSide; ++i) {
      for (int k = 0; k < kSide; ++k) {
        const double x = width_rad * ((i + 0.5) / kSide - 0.5);
        const double y = width_rad * ((k + 0.5) / kSide - 0.5);
        double bend = 0.0;
        for (const auto& wave : waves) bend += std::cos(wave.x() * x + wave.y() * y + wave.z());
        bend *= ratio * std::sqrt(2.0 / kWaves);
        const Eigen::Vector3d ray(x, y, 1.0), on_plane = -pi_c.d / pi_c.n.dot(ray) * ray;
        const Eigen::Vector2d at = axes.transpose() * (on_plane - Eigen::Vector3d::UnitZ());
        const Eigen::Vector3d row(1.0, at.x(), at.y());
        normal += row * row.transpose();
        moments += row * SignedDistance(pi_c, (1.0 + bend) * on_plane);
      }
    }
    squares += (normal.inverse() * moments).cwiseAbs2();
  }
  squares /= kDraws;
  return {std::sqrt(squares[0]), std::sqrt(std::max(squares[1], squares[2]))};
}

TEST(SigmasOfBend, AreThoseOfPlanesFittedToRandomBends) {
  for (const double incidence_deg : {0.0, 45.0, 60.0}) {
    for (const double lengths : {0.3, 1.0, 3.0, 8.0}) {
      SCOPED_TRACE(::testing::Message() << incidence_deg << " degrees, " << lengths);
      const double width_rad = lengths * kBendLength_rad,
                   incidence = incidence_deg * M_PI / 180;
      const BendSigmas drawn = Drawn(width_rad, 0.01, incidence);
      const BendSigmas ours = SigmasOfBend(0.01, SlantedPlane(1.0, incidence),
                                           Eigen::Vector3d::UnitZ(), width_rad * width_rad);
      EXPECT_NEAR(ours.offset_m / drawn.offset_m, 1.0, 0.35);
      EXPECT_NEAR(ours.angle_rad / drawn.angle_rad, 1.0, 0.35);
    }
  }
}

/// How much random bends curve a plane through (0, 0, z) along the image's rows and, where it slants,
/// its columns: root mean square of the second difference of its height, over many draws.
Eigen::Vector2d CurvatureDrawn(double z_m, double ratio, double incidence_rad) {
  constexpr int kDraws = 4000;
  constexpr double kStep = 0.1 * kBendLength_rad;
  const Plane pi_c = SlantedPlane(z_m, incidence_rad);
  Random random{5};
  Eigen::Vector2d squares = Eigen::Vector2d::Zero();
  for (int draw = 0; draw < kDraws; ++draw) {
    const Eigen::Vector2d wave(Normal(random) / kBendLength_rad,
                               Normal(random) / kBendLength_rad);
    const double phase = 2 * M_PI * random.Uniform();
    for (int axis = 0; axis < 2; ++axis) {
      double second = 0.0, step_m = 0.0;
      for (const int k : {-1, 0, 1}) {
        Eigen::Vector3d ray = Eigen::Vector3d::UnitZ();
        ray[axis] = k * kStep;
        const Eigen::Vector3d on_plane = -pi_c.d / pi_c.n.dot(ray) * ray;
        const double bend = ratio * std::sqrt(2.0) * std::cos(wave.dot(ray.head<2>()) + phase);
        second += (k == 0 ? -2 : 1) * SignedDistance(pi_c, (1.0 + bend) * on_plane);
        if (k == 1) step_m = (on_plane - z_m * Eigen::Vector3d::UnitZ()).norm();
      }
      squares[axis] += std::pow(second / (step_m * step_m), 2) / kDraws;
    }
  }
  return squares.cwiseSqrt();
}

TEST(SigmasOfBend, CurveAsRandomBendsDo) {
  for (const double z_m : {0.6, 1.5}) {
    const auto ours = [&](double incidence) {
      return SigmasOfBend(0.01, SlantedPlane(z_m, incidence), {0.0, 0.0, z_m}, 0.001)
          .curvature_per_m;
    };
    const Eigen::Vector2d frontal = CurvatureDrawn(z_m, 0.01, 0.0);
    EXPECT_NEAR(ours(0.0) / frontal.x(), 1.0, 0.1);
    EXPECT_NEAR(ours(0.0) / frontal.y(), 1.0, 0.1);
    // Along the slant a radian of view is more of the plane.
    const Eigen::Vector2d slanted = CurvatureDrawn(z_m, 0.01, 0.8);
    EXPECT_NEAR(ours(0.8) / slanted.y(), 1.0, 0.1);
    EXPECT_LT(slanted.x(), ours(0.8));
  }
}

TEST(SigmasOfBend, GrowWithTheBendAndTheOffsetWithTheDistance) {
  const auto at = [](double ratio, double z_m) {
    return SigmasOfBend(ratio, SlantedPlane(z_m, 0.3), {0.0, 0.0, z_m}, 0.02);
  };
  const BendSigmas one = at(0.003, 1.0), far = at(0.003, 2.0), twice = at(0.006, 1.0);
  EXPECT_DOUBLE_EQ(far.offset_m, 2 * one.offset_m);
  EXPECT_DOUBLE_EQ(far.angle_rad, one.angle_rad);
  EXPECT_DOUBLE_EQ(twice.offset_m, 2 * one.offset_m);
  EXPECT_DOUBLE_EQ(twice.angle_rad, 2 * one.angle_rad);
  EXPECT_DOUBLE_EQ(twice.curvature_per_m, 2 * one.curvature_per_m);
}

}  // namespace
}  // namespace slam
