#include "sim/sensor/report/sensor_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include "sim/base/angle.h"
#include "sim/trace/frame_renderer.h"

namespace sim {
namespace {

constexpr int kFrames = 20;
constexpr std::uint64_t kSeed = 1;

Camera NarrowView() {
  return {.width = 160, .height = 120, .fx = 2600, .fy = 2600, .cx = 79.5, .cy = 59.5};
}

/// A wall whose front goes through (0, z, 0), turned about the vertical.
Scene Wall(double z_m, double tilt_rad) {
  Scene scene;
  scene.name = "wall";
  Object wall;
  wall.id = 1;
  wall.class_name = wall.name = "wall";
  wall.size = {20.0, 0.1, 20.0};
  wall.q_wo = Eigen::AngleAxisd(tilt_rad, Eigen::Vector3d::UnitZ());
  wall.center_w = Eigen::Vector3d(0, z_m, 0) + wall.q_wo * Eigen::Vector3d(0, 0.05, 0);
  scene.objects.push_back(wall);
  return scene;
}

/// The camera at the origin, looking along world y.
Pose LookingAlongY() {
  Pose T_wc;
  T_wc.R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return T_wc;
}

/// The model without what a wall in a narrow view cannot show.
DepthModel OnlyTheWall(const DepthModel& model) {
  DepthModel bare = model;
  if (auto* kinect = std::get_if<KinectModel>(&bare)) kinect->bend = {};
  if (auto* azure = std::get_if<AzureModel>(&bare))
    azure->session_offset_m = 0, azure->bend = {};
  if (auto* d435 = std::get_if<D435Model>(&bare)) d435->baseline_m = 0, d435->bend = {};
  return bare;
}

double MedianGap(const std::set<double>& values) {
  std::vector<double> gaps;
  for (auto it = values.begin(); it != values.end() && std::next(it) != values.end(); ++it) {
    gaps.push_back(*std::next(it) - *it);
  }
  if (gaps.empty()) return 0;
  const auto middle = gaps.begin() + static_cast<std::ptrdiff_t>(gaps.size() / 2);
  std::nth_element(gaps.begin(), middle, gaps.end());
  return *middle;
}

WallMeasurement Measure(const DepthModel& model, double z_m, double tilt_rad) {
  const Camera camera = NarrowView();
  const Rendering rendering =
      FrameRenderer(Wall(z_m, tilt_rad), camera)
          .Render(LookingAlongY(),
                  {.colour = false, .projector_offset_m = SecondEyeOffset(model)});
  WallMeasurement wall{.z_m = z_m,
                       .tilt_rad = tilt_rad,
                       .stated_sd_m = DepthSigma(model, z_m, tilt_rad),
                       .stated_bias_m = DepthBias(model, z_m),
                       .stated_step_m = DepthStep(model, z_m)};
  double count = 0, sum = 0, random_sum = 0, squares = 0;
  std::set<double> depths;
  for (std::uint64_t frame = 0; frame < kFrames; ++frame) {
    const cv::Mat1d z = MeasureDepth(rendering, model, camera, kSeed, frame);
    for (int v = 0; v < z.rows; ++v) {
      for (int u = 0; u < z.cols; ++u) {
        if (!(z(v, u) > 0)) continue;
        // A tilted wall spans depths: errors are scaled to the sd stated at the middle.
        const double here = DepthSigma(
            model, rendering.depth_m(v, u),
            std::acos(std::min(1.0, static_cast<double>(rendering.incidence_cos(v, u)))));
        const double scale = here > 0 ? wall.stated_sd_m / here : 1.0;
        const double error = (z(v, u) - rendering.depth_m(v, u)) * scale;
        const double random = error - scale * DepthBias(model, rendering.depth_m(v, u));
        count += 1;
        sum += error;
        random_sum += random;
        squares += random * random;
        depths.insert(z(v, u));
      }
    }
  }
  // What is left of the errors without the stated bias is noise.
  if (count == 0) return wall;
  wall.bias_m = sum / count;
  const double mean = random_sum / count;
  wall.sd_m = std::sqrt(std::max(0.0, squares / count - mean * mean));
  wall.step_m = MedianGap(depths);
  return wall;
}

}  // namespace

SensorReport MeasureWalls(const Sensor& sensor) {
  const DepthModel model = OnlyTheWall(sensor.depth);
  SensorReport report;
  for (const double z : {0.6, 0.8, 1.0, 1.25, 1.5, 1.75, 2.0, 2.5, 3.0}) {
    report.by_depth.push_back(Measure(model, z, 0));
  }
  for (int degrees = 0; degrees <= 75; degrees += 15) {
    report.by_tilt.push_back(Measure(model, 1.0, degrees * kDegree_rad));
  }
  return report;
}

std::string ReportTable(const SensorReport& report) {
  std::string table =
      "    z  tilt   sd/mm           ratio  bias/mm          step/mm\n"
      "    m   deg  stated measured         stated measured  stated measured\n";
  const auto add = [&](const WallMeasurement& wall, bool with_step) {
    const double ratio = wall.stated_sd_m > 0 ? wall.sd_m / wall.stated_sd_m : 1.0;
    char line[160];
    std::snprintf(line, sizeof line, "%5.2f %5.0f %7.2f %8.2f %6.3f %7.2f %8.2f", wall.z_m,
                  wall.tilt_rad / kDegree_rad, 1e3 * wall.stated_sd_m, 1e3 * wall.sd_m, ratio,
                  1e3 * wall.stated_bias_m, 1e3 * wall.bias_m);
    table += line;
    if (with_step) {
      std::snprintf(line, sizeof line, " %7.2f %8.2f", 1e3 * wall.stated_step_m,
                    1e3 * wall.step_m);
      table += line;
    }
    table += "\n";
  };
  for (const WallMeasurement& wall : report.by_depth) add(wall, true);
  for (const WallMeasurement& wall : report.by_tilt) add(wall, false);
  return table;
}

}  // namespace sim
