#pragma once

#include "sim/detect/detector.h"
#include "sim/sensor/sensor.h"
#include "sim/trace/frame_renderer.h"
#include "sim/truth/frame_truth.h"
#include "sim/write/exposure.h"
#include "sim/write/timing.h"

namespace sim {

/// What is in front of the scene.
struct RigOptions {
  Camera camera;  ///< as it is; camera.yaml tells CameraAsTold
  Sensor sensor = SensorKind::kKinect1;
  DetectorKind detector = DetectorKind::kNoisy;
  std::uint64_t seed = 1;  ///< for all noise

  /// What names the sensor's device: what its parameters say, else the seed.
  std::uint64_t device() const;
  /// The camera as camera.yaml tells it.
  Camera CameraAsTold() const;
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
  /// A frame of a camera that stands still meanwhile, at time 0.
  SimulatedFrame Simulate(int frame, const Pose& T_wc) const;
  /// A frame of a moving camera: colour is exposed about shot.time_s, depth at one moment
  /// shot.DepthDelay_s() later. Truth is of shot.T_wc, the middle of the colour exposure.
  SimulatedFrame Simulate(int frame, const Shot& shot, const PoseAround& around) const;
  const RigOptions& options() const { return options_; }
  const std::vector<ScenePlane>& planes() const { return renderer_.standing().planes; }

 private:
  void RenderForDepth(const Pose& T_wc, double time_s, Rendering& out) const;
  /// In file units.
  cv::Mat1w Depth(int frame, const Rendering& rendering) const;

  RigOptions options_;
  Pose depth_error_;  ///< RegistrationError
  FrameRenderer renderer_;
  TruthMaker truth_;
  Detector detector_;
};

}  // namespace sim
