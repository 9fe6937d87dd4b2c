#pragma once

#include <cmath>

#include "sim/sensor/depth/azure_sensor.h"
#include "sim/sensor/sensor.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {

/// An Azure Kinect that measures exactly, at any distance.
inline AzureModel AzureAllOff() {
  return {.min_depth_m = 0,
          .max_depth_m = 1e9,
          .noise_scale = 0,
          .lateral_px = 0,
          .flying_pixels = false,
          .multipath_m = 0,
          .multipath_loss = 0,
          .wiggle_m = 0,
          .session_offset_m = 0,
          .hexagon = false,
          .rounding_m = 0};
}

/// A narrow view: rays within 2.2 deg of the axis, so that a wall is frontal all over.
inline Camera NarrowCamera() {
  return {.width = 160, .height = 120, .fx = 2600, .fy = 2600, .cx = 79.5, .cy = 59.5};
}

inline Rendering SensorView(const Scene& scene, const Camera& camera, const DepthModel& model,
                            const Pose& T_wc = LookAlongY()) {
  RenderOptions options;
  options.colour = false;
  options.projector_offset_m = SecondEyeOffset(model);
  return FrameRenderer(scene, camera).Render(T_wc, options);
}

struct ErrorMoments {
  double mean = 0, sd = 0, share = 0;
};

/// Of (measured - true) / unit(true depth, angle) over `frames` frames.
template <typename Unit>
ErrorMoments MeasureErrors(const Rendering& rendering, const Camera& camera,
                           const DepthModel& model, int frames, const Unit& unit) {
  double count = 0, sum = 0, squares = 0, pixels = 0;
  for (int frame = 0; frame < frames; ++frame) {
    const cv::Mat1d z =
        MeasureDepth(rendering, model, camera, 11, static_cast<std::uint64_t>(frame));
    for (int v = 0; v < z.rows; ++v) {
      for (int u = 0; u < z.cols; ++u) {
        if (!(rendering.depth_m(v, u) > 0)) continue;
        ++pixels;
        if (!(z(v, u) > 0)) continue;
        const double theta = std::acos(static_cast<double>(rendering.incidence_cos(v, u)));
        const double error =
            (z(v, u) - rendering.depth_m(v, u)) / unit(rendering.depth_m(v, u), theta);
        ++count;
        sum += error;
        squares += error * error;
      }
    }
  }
  ErrorMoments m;
  m.share = count / pixels;
  m.mean = sum / count;
  m.sd = std::sqrt(squares / count - m.mean * m.mean);
  return m;
}

/// A wall far away with a small board before it: edges at known pixels.
inline Scene BoardBeforeWall(double z_near, double z_far) {
  Scene scene = OneBoard(z_far);
  scene.objects.push_back(
      BoxObject(2, "box", Role::kRegular, {0, z_near + 0.0005, 0}, {0.2, 0.001, 0.2}));
  return scene;
}

/// A large board through (0, z_m, 0), turned by theta about the vertical.
inline Scene TiltedBoard(double z_m, double theta_rad) {
  Scene scene = OneBoard(z_m, 6.0);
  Object& board = scene.objects[0];
  board.q_wo = Eigen::AngleAxisd(theta_rad, Eigen::Vector3d::UnitZ());
  board.center_w = Eigen::Vector3d(0, z_m, 0) + board.q_wo * Eigen::Vector3d(0, 0.05, 0);
  return scene;
}

}  // namespace sim
