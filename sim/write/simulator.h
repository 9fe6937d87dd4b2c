#pragma once

#include "sim/detect/detector.h"
#include "sim/sensor/colour_sensor.h"
#include "sim/sensor/depth_sensor.h"
#include "sim/trace/frame_renderer.h"
#include "sim/truth/frame_truth.h"

namespace sim {

/// What is in front of the scene.
struct RigOptions {
  Camera camera;
  SensorKind sensor = SensorKind::kKinect1;
  DetectorKind detector = DetectorKind::kNoisy;
  std::uint64_t seed = 1;  ///< of all noise
};

/// One frame as it is recorded, with its truth; images are height x width.
struct SimulatedFrame {
  cv::Mat3b colour;     ///< OpenCV's channel order, blue first
  cv::Mat1w depth;      ///< file units: metres x camera.depth_factor, 0 = no measurement
  cv::Mat1w plane_id;   ///< truth
  cv::Mat1w object_id;  ///< truth
  FrameTruth truth;
  std::vector<Detection> detections;
};

/// Scene in, frames out, in memory. Const and thread-safe: a frame depends on the scene, the
/// options, its index and its pose alone.
class Simulator {
 public:
  Simulator(const Scene& scene, const RigOptions& options);
  SimulatedFrame Simulate(int frame, const Pose& T_wc) const;
  const RigOptions& options() const { return options_; }

 private:
  RigOptions options_;
  FrameRenderer renderer_;
  TruthMaker truth_;
  Detector detector_;
};

}  // namespace sim
