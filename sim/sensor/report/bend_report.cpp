#include "sim/sensor/report/bend_report.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace sim {
namespace {

constexpr double kSteps_m = 351.3;  // of the first Kinect: 8 x 585.5 px x 75 mm
constexpr int kBlock_px = 16;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint64_t kEarly = 0, kLate = 100000;  // frames: the drifting part is another

/// What large flat surfaces of a real kitchen leave, seen by a first Kinect (docs/sensors.md).
constexpr BentWall kReal[] = {
    {1.4, 1.01, 0.83}, {1.8, 0.79, 0.57}, {2.25, 0.66, 0.45}, {3, 0.57, 0.36}};

cv::Mat1d ResidualsOfWall(const DepthModel& model, double z_m, std::uint64_t seed,
                          std::uint64_t frame) {
  const Camera camera;
  return DisparityResiduals(MeasureDepth(BareWall(camera, z_m), model, camera, seed, frame));
}

double Rms(const cv::Mat1d& values) {
  double sum = 0, count = 0;
  for (const double x : values) {
    if (!std::isfinite(x)) continue;
    sum += x * x;
    count += 1;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

}  // namespace

Rendering BareWall(const Camera& camera, double z_m) {
  Rendering wall;
  const cv::Size size(camera.width, camera.height);
  wall.depth_m = cv::Mat1d(size, z_m);
  wall.plane_id = cv::Mat1w(size, 1);
  wall.object_id = cv::Mat1w(size, 1);
  wall.incidence_cos = cv::Mat1f(size, 1.0F);
  return wall;
}

cv::Mat1d DisparityResiduals(const cv::Mat1d& z_m) {
  // Normal equations of 351.3 / z = a u + b v + c.
  cv::Matx33d A = cv::Matx33d::zeros();
  cv::Vec3d b(0, 0, 0);
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      if (!(z_m(v, u) > 0)) continue;
      const cv::Vec3d at(u, v, 1);
      A += at * at.t();
      b += at * (kSteps_m / z_m(v, u));
    }
  }
  const cv::Vec3d plane = A.solve(b, cv::DECOMP_SVD);
  cv::Mat1d residuals(z_m.size(), kNone);
  for (int v = 0; v < z_m.rows; ++v) {
    for (int u = 0; u < z_m.cols; ++u) {
      if (z_m(v, u) > 0) residuals(v, u) = kSteps_m / z_m(v, u) - plane.dot(cv::Vec3d(u, v, 1));
    }
  }
  return residuals;
}

cv::Mat1d BlockMeans(const cv::Mat1d& residuals) {
  cv::Mat1d means(residuals.rows / kBlock_px, residuals.cols / kBlock_px, kNone);
  for (int j = 0; j < means.rows; ++j) {
    for (int i = 0; i < means.cols; ++i) {
      const cv::Mat1d block =
          residuals(cv::Rect(i * kBlock_px, j * kBlock_px, kBlock_px, kBlock_px));
      double sum = 0;
      int count = 0;
      for (const double x : block) {
        if (std::isfinite(x)) sum += x, ++count;
      }
      if (2 * count >= kBlock_px * kBlock_px) means(j, i) = sum / count;
    }
  }
  return means;
}

double CorrelationOf(const cv::Mat1d& a, const cv::Mat1d& b) {
  double aa = 0, bb = 0, ab = 0;
  for (int v = 0; v < a.rows; ++v) {
    for (int u = 0; u < a.cols; ++u) {
      const double x = a(v, u), y = b(v, u);
      if (!std::isfinite(x) || !std::isfinite(y)) continue;
      aa += x * x, bb += y * y, ab += x * y;
    }
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0;
}

double Autocorrelation(const cv::Mat1d& image, cv::Point shift) {
  const cv::Rect overlap(0, 0, image.cols - shift.x, image.rows - shift.y);
  return CorrelationOf(image(overlap), image(overlap + shift));
}

BendReport MeasureBend(const Sensor& sensor, int devices) {
  BendReport report;
  for (const BentWall& real : kReal) report.walls.push_back({real.z_m, 0, 0});
  const double share = 1.0 / devices;
  for (int i = 1; i <= devices; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    for (BentWall& wall : report.walls) {
      const cv::Mat1d rest = ResidualsOfWall(sensor.depth, wall.z_m, seed, kEarly);
      wall.pixels += share * Rms(rest);
      wall.blocks += share * Rms(BlockMeans(rest));
    }
    const double z_m = report.walls.front().z_m;
    report.fixed_share +=
        share * CorrelationOf(BlockMeans(ResidualsOfWall(sensor.depth, z_m, seed, kEarly)),
                              BlockMeans(ResidualsOfWall(sensor.depth, z_m, seed, kLate)));
    cv::Mat1d pattern;
    DevicePattern(sensor.depth, Camera{}, seed).convertTo(pattern, CV_64F);
    if (pattern.empty()) continue;
    report.along_x_32 += share * Autocorrelation(pattern, {32, 0});
    report.along_x_56 += share * Autocorrelation(pattern, {56, 0});
    report.along_x_110 += share * Autocorrelation(pattern, {110, 0});
    report.along_y_32 += share * Autocorrelation(pattern, {0, 32});
    report.along_y_112 += share * Autocorrelation(pattern, {0, 112});
  }
  return report;
}

std::string BendTable(const BendReport& report) {
  std::string table =
      "what is left of a wall, steps of 1/8 px    rms of pixels   rms of 16 x 16 blocks\n"
      "                                     z/m   here    real    here    real\n";
  for (std::size_t i = 0; i < report.walls.size(); ++i) {
    const BentWall& wall = report.walls[i];
    table += fmt::format("{:>40.2f} {:6.2f} {:7.2f} {:7.2f} {:7.2f}\n", wall.z_m, wall.pixels,
                         kReal[i].pixels, wall.blocks, kReal[i].blocks);
  }
  table += fmt::format("share of it that stays: {:.2f} (real 0.75)\n", report.fixed_share);
  table += fmt::format(
      "autocorrelation along x after 32, 56, 110 px: {:.2f} {:.2f} {:.2f} (real 0.44 0.00 "
      "-0.50)\n"
      "autocorrelation along y after 32, 112 px: {:.2f} {:.2f} (real 0.77 0.28)\n",
      report.along_x_32, report.along_x_56, report.along_x_110, report.along_y_32,
      report.along_y_112);
  return table;
}

}  // namespace sim
