#include "slam/run/run_sequence.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <opencv2/core/utility.hpp>
#include <thread>
#include <utility>

#include "io/input_error.h"
#include "slam/diagnose/camera_check.h"
#include "slam/diagnose/depth_clock.h"
#include "slam/input/camera_reader.h"
#include "slam/input/frame_gate.h"
#include "slam/input/sequence_reader.h"
#include "slam/model/map_queries.h"
#include "slam/run/config_file.h"
#include "slam/run/repeated_frame.h"
#include "slam/run/run_writer.h"

namespace slam {
namespace {

constexpr std::array<std::pair<Variant, const char*>, 4> kVariants = {
    {{Variant::kFull, "full"},
     {Variant::kNoAssociation, "no-association"},
     {Variant::kNoProcessingNoAssociation, "no-processing-no-association"},
     {Variant::kPoints, "points"}}};

std::string DetectorChoice(const RunOptions& options) {
  if (options.variant == Variant::kPoints) return "none";  // boxes serve planes alone
  if (!options.detector.empty()) return options.detector;
  return std::filesystem::exists(options.sequence / "detections.jsonl") ? "replay" : "none";
}

RunInfo Describe(const RunOptions& options, const std::string& detector) {
  RunInfo info;
  info.sequence = options.sequence;
  info.variant = VariantName(options.variant);
  info.association = options.variant == Variant::kPoints ? "none"
                     : options.variant == Variant::kFull ? "integrated"
                                                         : "parameters";
  info.detector = detector;
  info.seed = options.seed;
  info.version = options.version;
  info.options = ConfigAsJson(options.config);
  if (!options.camera.empty()) info.options["camera"] = options.camera;
  return info;
}

/// A pose tied to a keyframe, which moves on when the map is adjusted.
struct TiedPose {
  double timestamp_s = 0.0;
  int reference = kNone;
  Pose T_cr;
};

std::vector<TimedPose> FollowKeyframes(const std::vector<TiedPose>& tied, const Map& map) {
  std::vector<TimedPose> trajectory;
  for (const TiedPose& pose : tied) {
    trajectory.push_back(
        {pose.timestamp_s, Normalised(pose.T_cr * KeyframePose(map, pose.reference))});
  }
  return trajectory;
}

Frame FrameOf(const RecordedFrame& recorded) {
  Frame frame;
  frame.index = recorded.index;
  frame.timestamp_s = recorded.timestamp_s;
  frame.gray = recorded.gray;
  frame.depth_m = recorded.depth_m;
  return frame;
}

std::optional<Pose> PoseOf(const TrackedFrame& tracked) {
  return tracked.report.tracked ? std::optional(tracked.frame.T_cw) : std::nullopt;
}

std::string RepeatsWarning(int repeats) {
  return std::to_string(repeats) + (repeats == 1 ? " frame repeats" : " frames repeat") +
         " the images of the one before: taken for the same place, nothing learned";
}

std::vector<std::string> WarningsOf(const FrameGate& gate, int repeats,
                                    CameraCheck& camera_check, const DepthClock& depth_clock) {
  std::vector<std::string> warnings = gate.Warnings();
  if (repeats > 0) warnings.push_back(RepeatsWarning(repeats));
  if (const std::string warning = camera_check.Warning(); !warning.empty()) {
    warnings.push_back(warning);
  }
  for (std::string& late : depth_clock.Warnings()) warnings.push_back(std::move(late));
  return warnings;
}

int ThreadsOf(const RunOptions& options) {
  const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  return options.threads > 0 ? options.threads : cores;
}

void CountMap(const Map& map, RunOutcome& outcome) {
  for (const Keyframe& keyframe : map.keyframes) outcome.keyframes += !keyframe.culled;
  for (const MapPoint& point : map.points) outcome.map_points += !point.culled;
  for (const MapPlane& plane : map.planes)
    outcome.map_planes += plane.status == LandmarkStatus::kLandmark;
}

RunOutcome Run(LiveCamera input, const RunOptions& options, const std::string& detector) {
  const auto start = std::chrono::steady_clock::now();
  // Its own threads would only compete with ours.
  cv::setNumThreads(1);
  Tracker tracker(input.camera, options.config, options.variant, std::move(input.detector),
                  options.seed, ThreadsOf(options), options.before_mapping);
  RunWriter writer(options.run, Describe(options, detector),
                   {.force = options.force,
                    .save_segmentation = options.save_segmentation,
                    .frames = input.frames.size()});

  RunOutcome outcome;
  FrameGate gate(input.camera);
  CameraCheck camera_check(input.camera, options.config.point_features.scale);
  DepthClock depth_clock(input.camera);
  std::optional<TrackedFrame> last;
  int repeats = 0, in_a_row = 0;
  std::vector<TiedPose> tied;
  const int total = input.frames.size();
  tied.reserve(static_cast<std::size_t>(total));
  for (int i = 0; i < total && !outcome.stopped; ++i) {
    RecordedFrame recorded = input.frames.Read(i);
    if (gate.Takes(recorded)) {
      recorded.index = outcome.frames++;
      if (last && in_a_row < kMostRepeats && RepeatsImages(*last, recorded)) {
        RepeatAt(recorded, *last);
        ++repeats, ++in_a_row;
      } else {
        in_a_row = 0;
        last = {FrameOf(recorded), recorded.bgr, {}};
        last->report = tracker.TrackFrame(last->frame, last->bgr);
        depth_clock.Observe(last->frame.timestamp_s, last->frame.depth_m, PoseOf(*last));
        if (PoseOf(*last) && camera_check.See(last->frame) && options.warn) {
          options.warn(camera_check.Warning());
        }
      }
      const TrackReport& report = last->report;
      writer.WriteFrame({last->frame, report.tracked, report.times, StateName(report.points)});
      outcome.tracked += report.tracked ? 1 : 0;
      if (report.tracked) {
        tied.push_back({last->frame.timestamp_s, report.reference, report.T_cr});
      }
    }
    if (options.progress) options.progress(i + 1, total);
    outcome.stopped = i + 1 < total && options.stop && options.stop();
  }
  tracker.Finish(outcome.stopped ? MappingWorker::Waiting::kDrop : MappingWorker::Waiting::kDo);
  outcome.loops = tracker.loops();
  // A closed loop moves the past; without one the poses stay as they were found.
  writer.Finish(tracker.map(), outcome.loops > 0 ? FollowKeyframes(tied, tracker.map())
                                                 : std::vector<TimedPose>{});
  outcome.warnings = WarningsOf(gate, repeats, camera_check, depth_clock);
  if (const int unmapped = tracker.unmapped_keyframes(); unmapped > 0 && !outcome.stopped) {
    outcome.warnings.push_back(std::to_string(unmapped) +
                               " keyframes came too fast to be mapped on their own");
  }
  CountMap(tracker.map(), outcome);
  outcome.wall_time_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return outcome;
}

}  // namespace

const char* VariantName(Variant variant) {
  return std::find_if(kVariants.begin(), kVariants.end(),
                      [&](const auto& entry) { return entry.first == variant; })
      ->second;
}

Variant VariantOf(const std::string& name) {
  std::string known;
  for (const auto& [variant, text] : kVariants) {
    if (name == text) return variant;
    known += (known.empty() ? "" : ", ") + std::string(text);
  }
  throw io::InputError("--variant " + name, "unknown variant; expected one of " + known);
}

RunOutcome RunSequence(const RunOptions& options) {
  if (!std::filesystem::is_directory(options.sequence)) {
    throw io::InputError(
        options.sequence.string(),
        "no such folder; expected a sequence made by pas sim, or a TUM RGB-D folder");
  }
  const Camera camera = ChooseCamera(options.camera, options.sequence);
  SequenceReader reader(options.sequence, camera, {.prefetch = ThreadsOf(options) > 1});
  const std::string detector = DetectorChoice(options);
  RunOutcome outcome = Run({reader, camera,
                            MakeDetector(detector, options.sequence, camera,
                                         options.config.classes, options.config.yolox)},
                           options, detector);
  const auto& warnings = reader.warnings().text;
  outcome.warnings.insert(outcome.warnings.begin(), warnings.begin(), warnings.end());
  return outcome;
}

RunOutcome RunLive(LiveCamera live, const RunOptions& options) {
  // Boxes serve planes alone.
  if (options.variant == Variant::kPoints) live.detector = nullptr;
  const std::string detector = live.detector ? "live" : "none";
  return Run(std::move(live), options, detector);
}

}  // namespace slam
