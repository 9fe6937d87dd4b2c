#pragma once

#include <map>
#include <utility>
#include <vector>

#include "eval/planes/association.h"
#include "sim/motion/trajectory.h"
#include "sim/write/simulator.h"
#include "slam/detect/detections.h"
#include "slam/run/tracker.h"

/// Simulated frames handed to the estimator in memory, without files.
namespace live {

slam::Camera CameraOf(const sim::Camera& camera);
/// T_cw of a simulated pose.
slam::Pose PoseOf(const sim::Pose& T_wc);
/// What the camera gives of a simulated frame: no truth.
slam::Frame FrameOf(const sim::SimulatedFrame& simulated, int index, double timestamp_s,
                    double depth_factor);
std::vector<slam::Detection> DetectionsOf(const sim::SimulatedFrame& simulated);

/// True plane that holds most pixels of each frame plane, 0 if most show none that is scored
/// (planes of structure and regular objects are). Counted here, not by eval's code.
std::vector<int> TruthOf(const slam::Frame& frame, const sim::SimulatedFrame& simulated,
                         const sim::Scene& scene);

/// Frame planes of one frame as the records of eval::ScoreAssociation.
void AppendRecords(const slam::Frame& frame, const std::vector<int>& truth,
                   std::vector<eval::AssociationRecord>& records);

/// A detector that says what it was told for this frame.
class ToldDetector : public slam::Detector {
 public:
  explicit ToldDetector(const std::vector<slam::Detection>& next) : next_(next) {}
  std::vector<slam::Detection> Detect(double, const cv::Mat3b&) override { return next_; }

 private:
  const std::vector<slam::Detection>& next_;
};

}  // namespace live
