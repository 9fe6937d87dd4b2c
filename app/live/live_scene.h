#pragma once

#include <deque>
#include <future>
#include <memory>
#include <string>

#include "app/live/truth_folder.h"
#include "sim/write/recording.h"
#include "slam/detect/detections.h"
#include "slam/geometry/camera.h"
#include "slam/input/frame_source.h"

namespace app {

/// A rendered scene as a camera: frames are made while the estimator works, `ahead` of them on
/// threads of their own, and never become files. What leaves is what a camera and a detector
/// give: colour, depth, time and boxes, with the values that files of the same recording hold.
/// What it is scored against it writes beside the run (KeepTruth).
/// Memory does not grow with the number of frames. One caller at a time.
class LiveScene : public slam::FrameSource {
 public:
  /// @param ahead  at least 0; never changes a frame
  LiveScene(const sim::Scene& scene, const sim::RigOptions& rig, sim::Recording recording,
            int ahead);

  /// Before the first frame: from now on the truth of every frame that is read is written.
  /// @param options  that the recording was planned with, for the manifest
  /// @returns who writes it; lives as long as this object
  slam::LiveTruth& KeepTruth(const sim::Scene& scene, const sim::SequenceOptions& options);

  int size() const override { return recording_.frames(); }
  slam::RecordedFrame Read(int i) override;

  /// The camera as camera.yaml of a sequence would give it.
  slam::Camera camera() const;
  /// Boxes of the frame that was read last; null for a rig without a detector. It refers to
  /// this object.
  std::unique_ptr<slam::Detector> MakeDetector(const slam::ClassTable& classes) const;

 private:
  struct Made {
    slam::RecordedFrame frame;
    std::string detections;  ///< a line of detections.jsonl
    TruthRecord truth;       ///< when it is kept
  };
  Made Make(int i) const;

  sim::Simulator simulator_;
  sim::Recording recording_;
  int ahead_count_;
  std::unique_ptr<TruthFolder> truth_;
  std::string detections_;
  int next_ = 0;                         ///< first frame that nobody makes yet
  std::deque<std::future<Made>> ahead_;  ///< last: its threads must end before the rest
};

}  // namespace app
