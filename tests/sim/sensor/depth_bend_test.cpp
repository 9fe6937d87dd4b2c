#include "sim/sensor/depth/depth_bend.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <thread>
#include <vector>

#include "sim/sensor/report/bend_report.h"
#include "sim/sensor/sensor.h"
#include "tests/sim/sensor/sensor_measurements.h"

namespace sim {
namespace {

constexpr double kRms = 0.0033;

double Rms(const cv::Mat1d& values) {
  return std::sqrt(values.dot(values) / static_cast<double>(values.total()));
}

KinectModel Bent(int device) {
  KinectModel model;
  model.bend = {.rms = kRms, .device = device};
  return model;
}

cv::Mat1d WallResiduals(double z_m, const KinectModel& model, std::uint64_t frame) {
  const Camera camera;
  return DisparityResiduals(MeasureDepth(BareWall(camera, z_m), model, camera, 5, frame));
}

struct Measured {
  double z_m, pixels, blocks;  ///< metres; rms in steps
};

// Large flat surfaces of a real kitchen, single frames.
constexpr Measured kReal[] = {
    {1.4, 1.01, 0.83}, {1.8, 0.79, 0.57}, {2.25, 0.66, 0.45}, {3, 0.57, 0.36}};
constexpr int kDevices = 12;

TEST(DepthBend, LeavesOfAWallWhatARealKinectLeaves) {
  for (const Measured& real : kReal) {
    double pixels = 0, blocks = 0;
    for (int device = 1; device <= kDevices; ++device) {
      const cv::Mat1d rest = WallResiduals(real.z_m, Bent(device), 3);
      pixels += Rms(rest) / kDevices;
      blocks += Rms(BlockMeans(rest)) / kDevices;
    }
    EXPECT_NEAR(blocks, real.blocks, 0.25 * real.blocks) << real.z_m << " m";
    EXPECT_NEAR(pixels, real.pixels, 0.25 * real.pixels) << real.z_m << " m";
  }
}

TEST(DepthBend, IsMostlyThePatternOfTheDevice) {
  double share = 0;
  for (int device = 1; device <= kDevices; ++device) {
    share += CorrelationOf(BlockMeans(WallResiduals(1.5, Bent(device), 0)),
                           BlockMeans(WallResiduals(1.5, Bent(device), 100000))) /
             kDevices;
  }
  EXPECT_GT(share, 0.65);
  EXPECT_LT(share, 0.85);
}

/// Where the autocorrelation along x or y first falls below `level`, pixels; averaged over devices.
double FallsBelow(double level, cv::Point along) {
  constexpr int kStep_px = 8;
  std::vector<cv::Mat1d> patterns(kDevices);
  for (int i = 0; i < kDevices; ++i) {
    DevicePattern(Bent(i + 1).bend, Camera{}, 0)
        .convertTo(patterns[static_cast<std::size_t>(i)], CV_64F);
  }
  double before = 1;
  for (int lag_px = kStep_px;; lag_px += kStep_px) {
    double here = 0;
    for (const cv::Mat1d& p : patterns) here += Autocorrelation(p, lag_px * along) / kDevices;
    if (here < level) return lag_px - kStep_px * (level - here) / (before - here);
    before = here;
  }
}

// The real one: 0.44 after 32 pixels and 0 after 56 along x; 0.77 after 32 and 0.28 after 112
// along y, so 0.5 after 76.
TEST(DepthBend, IsABandAcrossTheImageAsWideAsARealOne) {
  EXPECT_NEAR(FallsBelow(0.44, {1, 0}), 32, 0.3 * 32);
  EXPECT_NEAR(FallsBelow(0, {1, 0}), 56, 0.3 * 56);
  EXPECT_NEAR(FallsBelow(0.5, {0, 1}), 76, 0.3 * 76);
}

// A known image has known residuals: what is affine in the pixel goes, the rest stays.
TEST(DisparityResiduals, AreWhatNoPlaneExplains) {
  cv::Mat1d z(480, 640);
  const auto wave = [](int u) { return 0.3 * std::cos(2 * M_PI * (u + 0.5) / 64); };
  for (int v = 0; v < z.rows; ++v) {
    for (int u = 0; u < z.cols; ++u) z(v, u) = 351.3 / (150 + 0.1 * u - 0.05 * v + wave(u));
  }
  z(100, 200) = 0;
  const cv::Mat1d rest = DisparityResiduals(z);
  EXPECT_TRUE(std::isnan(rest(100, 200)));
  EXPECT_NEAR(rest(17, 330), wave(330), 1e-3);
  // The mean of a wave over a quarter of it.
  EXPECT_NEAR(BlockMeans(rest)(3, 20),
              0.3 * std::sin(M_PI / 4) / (M_PI / 4) * std::cos(M_PI / 4), 2e-3);
  EXPECT_NEAR(Autocorrelation(BlockMeans(rest), {2, 0}), -1, 1e-2);
}

TEST(BendReport, OfACleanSensorIsItsNoise) {
  const BendReport report = MeasureBend(SensorKind::kKinect1Clean, 1);
  EXPECT_LT(report.walls[0].blocks, 0.12);
  EXPECT_LT(report.fixed_share, 0.2);
  EXPECT_EQ(report.along_x_32, 0);
}

TEST(DepthBend, BendsWhatTheOthersMeasureToo) {
  for (const SensorKind kind : {SensorKind::kAzure, SensorKind::kD435}) {
    Sensor sensor(kind);
    const double flat = MeasureBend(sensor, 2).walls[0].blocks;
    if (auto* azure = std::get_if<AzureModel>(&sensor.depth)) azure->bend.rms = kRms;
    if (auto* d435 = std::get_if<D435Model>(&sensor.depth)) d435->bend.rms = kRms;
    const BendReport report = MeasureBend(sensor, 2);
    // Beside its own noise: 0.0033 of 351.3 m / 1.4 m is 0.83 steps.
    EXPECT_NEAR(std::sqrt(std::pow(report.walls[0].blocks, 2) - flat * flat), 0.83, 0.25)
        << sensor.name;
    EXPECT_GT(report.fixed_share, 0.55) << sensor.name;
  }
}

// Without noise only the drifting part differs between two frames far apart: twice its power.
TEST(DepthBend, DriftsWithTheFramesWhateverMeasures) {
  constexpr double kDrift = 0.4;
  AzureModel azure = AzureAllOff();
  D435Model d435{
      .baseline_m = 0, .subpixel_px = 0, .grid_px = 0, .ripple_px = 0, .rounding_m = 0};
  KinectModel kinect{.projector_offset_m = 0, .noise_scale = 0, .quantise = false};
  kinect.bend = azure.bend = d435.bend = {.rms = kRms, .drift_share = kDrift};
  const Camera camera = Resize(Camera{}, 320, 240);
  for (const DepthModel& model : {DepthModel(kinect), DepthModel(azure), DepthModel(d435)}) {
    const Rendering wall = SensorView(OneBoard(1.5), camera, model);
    const auto share = [&](std::uint64_t frame) {
      return cv::Mat1d(MeasureDepth(wall, model, camera, 3, frame) / 1.5 - 1);
    };
    const double pixels = camera.width * camera.height;
    const double moved = cv::norm(share(2) - share(1002)) / std::sqrt(pixels);
    EXPECT_NEAR(moved / kRms, std::sqrt(2 * kDrift), 0.3) << model.index();
    EXPECT_LT(cv::norm(share(2) - share(3)) / std::sqrt(pixels), 0.2 * kRms) << model.index();
  }
}

TEST(DepthBend, IsTheSameOfADeviceWhateverTheSeedAndTheSizeOfTheImage) {
  const DepthBend bend{.rms = kRms, .device = 7};
  const Camera large, small = Resize(large, 320, 240);
  const cv::Mat1f p = DevicePattern(bend, large, 1), q = DevicePattern(bend, small, 2);
  // Pixel (u, v) of the small image lies between four of the large one.
  for (int v = 0; v < small.height; v += 40) {
    for (int u = 0; u < small.width; u += 40) {
      const double mean = cv::mean(p(cv::Rect(2 * u, 2 * v, 2, 2)))[0];
      EXPECT_NEAR(mean, static_cast<double>(q(v, u)), 0.01 * kRms);
    }
  }
}

// The pattern goes with the ray, so with an image of oblong pixels it is drawn out as that is.
TEST(DepthBend, IsTheSameOfADeviceInAnImageWithOblongPixels) {
  const DepthBend bend{.rms = kRms, .device = 7};
  const Camera square;
  const cv::Mat1f p = DevicePattern(bend, square, 1);
  for (const auto& [across, down] : {std::pair{2, 1}, {1, 2}}) {
    const Camera oblong = Resize(square, square.width / across, square.height / down);
    const cv::Mat1f q = DevicePattern(bend, oblong, 1);
    for (int v = 0; v < oblong.height; v += 40) {
      for (int u = 0; u < oblong.width; u += 40) {
        const cv::Rect seen(across * u, down * v, across, down);
        EXPECT_NEAR(cv::mean(p(seen))[0], static_cast<double>(q(v, u)), 0.01 * kRms)
            << across << " " << down;
      }
    }
  }
}

TEST(DepthBend, OfSeedsAreDifferentDevices) {
  const DepthBend bend{.rms = kRms};
  const cv::Mat1f p = DevicePattern(bend, Camera{}, 1), q = DevicePattern(bend, Camera{}, 2);
  EXPECT_LT(std::abs(p.dot(q)) / std::sqrt(p.dot(p) * q.dot(q)), 0.5);
}

TEST(DepthBend, BetweenItsKnotsIsTheFieldToTwoPerCent) {
  const DepthBend bend{.rms = kRms, .drift_share = 0, .device = 3};
  for (const int width : {640, 320, 160}) {
    Camera camera;
    const double share = width / 640.0;
    camera.width = width, camera.height = width * 3 / 4;
    camera.fx *= share, camera.fy *= share, camera.cx *= share, camera.cy *= share;
    const cv::Mat1f exact = DevicePattern(bend, camera, 1);
    const BendField field(bend, camera, 1, 0);
    cv::Mat1f p(exact.size());
    for (int v = 0; v < p.rows; ++v) field.Row(v, {p[v], static_cast<std::size_t>(p.cols)});
    EXPECT_LT(cv::norm(p, exact, cv::NORM_L2) / cv::norm(exact, cv::NORM_L2), 0.02) << width;
  }
}

// Each thread keeps the device's part of the field it was last asked for.
TEST(DepthBend, OfARecordingDoesNotHangOnThoseBefore) {
  const DepthBend drawn{.rms = kRms}, named{.rms = kRms, .device = 3};
  const Camera large, small = Resize(large, 320, 240);
  const auto row = [](const DepthBend& bend, const Camera& camera, std::uint64_t seed) {
    std::vector<float> p(static_cast<std::size_t>(camera.width));
    BendField(bend, camera, seed, 5).Row(77, p);
    return p;
  };
  const auto alone = [&](const DepthBend& bend, const Camera& camera, std::uint64_t seed) {
    std::vector<float> p;
    std::thread([&] { p = row(bend, camera, seed); }).join();
    return p;
  };
  for (int round = 0; round < 2; ++round) {
    for (const DepthBend& bend : {drawn, named}) {
      for (const Camera& camera : {large, small}) {
        for (const std::uint64_t seed : {1u, 2u}) {
          EXPECT_EQ(row(bend, camera, seed), alone(bend, camera, seed));
        }
      }
    }
  }
}

}  // namespace
}  // namespace sim
