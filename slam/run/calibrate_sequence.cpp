#include "slam/run/calibrate_sequence.h"

#include <algorithm>
#include <map>
#include <opencv2/core/utility.hpp>
#include <optional>

#include "io/folder_kind.h"
#include "slam/input/camera_reader.h"
#include "slam/input/frame_gate.h"
#include "slam/input/frame_of.h"
#include "slam/input/repeated_images.h"
#include "slam/input/sequence_reader.h"
#include "slam/run/tracker.h"
#include "slam/segment/plane_segments.h"

namespace slam {
namespace {

using PosesByTime = std::map<double, Pose>;

/// What the passes over a recording share.
struct PassOverFrames {
  const CalibrateOptions& options;
  const Camera& camera;
  SequenceReader& reader;
  int total = 0;  ///< frames
  bool stopped = false;
  std::vector<std::string> warnings{};  ///< of the last pass's images

  template <typename Take>
  void Run(const char* name, const Take& take) {
    FrameGate gate(camera);
    RepeatedImages repeated;
    for (int i = 0; i < total && !stopped; ++i) {
      RecordedFrame recorded = reader.Read(i);
      if (gate.Takes(recorded) && !repeated.Repeats(recorded)) take(recorded);
      if (options.progress) options.progress(name, i + 1, total);
      stopped = options.stop && options.stop();
    }
    warnings = gate.Warnings();
  }
};

/// By points alone: poses T_dw of the depth camera in the frames that are tracked.
PosesByTime TrackAll(PassOverFrames& pass, const Config& config) {
  Config points = config;
  points.depth_warp.source = "off";
  points.async_mapping = false;
  Tracker tracker(pass.camera, points, Variant::kPoints, nullptr, 0, 1);
  PosesByTime poses;
  int index = 0;
  pass.Run("tracking", [&](const RecordedFrame& recorded) {
    Frame frame = FrameOf(recorded, index++);
    if (!tracker.TrackFrame(frame, recorded.bgr).tracked) return;
    poses[frame.timestamp_s] = frame.T_dc() * frame.T_cw;
  });
  return poses;
}

/// Learns from the planes of all frames with a pose.
WarpLearner LearnFrom(PassOverFrames& pass, const char* name, const PosesByTime& poses,
                      const Config& config, const std::optional<DepthWarp>& known) {
  WarpLearner learner(pass.camera, config.sensor.noise, config.depth_warp);
  PlaneExtractor extractor(PixelRays(pass.camera), config.sensor, config.plane_extraction);
  const Straightening straightening = known ? StraighteningBy(*known) : Straightening{};
  pass.Run(name, [&](const RecordedFrame& recorded) {
    const auto pose = poses.find(recorded.timestamp_s);
    if (pose == poses.end() || !learner.Wants(recorded.timestamp_s, pose->second)) return;
    Frame frame = FrameOf(recorded, 0);
    frame.depth_m = Straightened(recorded.depth_m, straightening);
    extractor.Extract(frame);
    learner.Observe(frame.timestamp_s, recorded.depth_m, frame.plane_labels, pose->second);
  });
  learner.Finish();
  return learner;
}

}  // namespace

Calibration CalibrateSequence(const CalibrateOptions& options) {
  cv::setNumThreads(1);
  io::RequireRecording(options.sequence);
  const CameraFile chosen = ChooseCamera(options.camera, options.sequence);
  const Camera& camera = chosen.camera;
  SequenceReader reader(options.sequence, camera);
  PassOverFrames pass{options, camera, reader};
  pass.total = options.frames > 0 ? std::min(options.frames, reader.size()) : reader.size();

  Calibration calibration;
  const PosesByTime poses = TrackAll(pass, options.config);
  const WarpLearner first = LearnFrom(pass, "planes", poses, options.config, std::nullopt);
  const WarpLearner second =
      LearnFrom(pass, "planes again", poses, options.config, first.Warp());
  calibration.warp = second.Warp();
  calibration.evidence = second.evidence();
  calibration.tracked = static_cast<int>(poses.size());
  calibration.stopped = pass.stopped;
  calibration.warnings = chosen.warnings;
  for (const auto& more : {reader.warnings(), pass.warnings})
    calibration.warnings.insert(calibration.warnings.end(), more.begin(), more.end());
  return calibration;
}

}  // namespace slam
