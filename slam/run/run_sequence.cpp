#include "slam/run/run_sequence.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <opencv2/core/utility.hpp>
#include <optional>
#include <thread>
#include <utility>

#include "io/folder_kind.h"
#include "io/input_error.h"
#include "io/path_type.h"
#include "slam/base/index.h"
#include "slam/diagnose/camera_check.h"
#include "slam/diagnose/depth_clock.h"
#include "slam/input/camera_reader.h"
#include "slam/input/sequence_reader.h"
#include "slam/model/map_queries.h"
#include "slam/run/config_file.h"
#include "slam/run/first_look.h"
#include "slam/run/frames_ahead.h"
#include "slam/run/lost_frames.h"
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
  return io::Exists(options.sequence / "detections.jsonl") ? "replay" : "none";
}

RunInfo Describe(const RunOptions& options, const Camera& camera, const std::string& detector,
                 int frames) {
  RunInfo info;
  info.sequence = options.sequence;
  info.sequence_frames = frames;
  info.variant = VariantName(options.variant);
  const AssociationRule rule = options.variant == Variant::kFull
                                   ? options.config.association.rule
                                   : AssociationRule::kParameters;
  info.association = options.variant == Variant::kPoints
                         ? "none"
                         : AssociationRuleNames()[static_cast<std::size_t>(rule)];
  info.detector = detector;
  info.camera = camera;
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
  trajectory.reserve(tied.size());
  for (const TiedPose& pose : tied) {
    trajectory.push_back(
        {pose.timestamp_s, Normalised(pose.T_cr * KeyframePose(map, pose.reference))});
  }
  return trajectory;
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

/// One run, frame by frame: what goes through the tracker, who watches the input, and what the
/// writer is told.
class SequenceRun {
 public:
  /// @param doubts  warnings about the input that are known before the first frame
  SequenceRun(LiveCamera input, const RunOptions& options, const std::string& detector,
              std::vector<std::string> doubts)
      : options_(options),
        threads_(ThreadsOf(options)),
        frames_(input.frames),
        comes_again_(input.comes_again),
        camera_(input.camera),
        truth_(input.truth),
        doubts_(std::move(doubts)),
        tracker_(input.camera, options.config, options.variant, std::move(input.detector),
                 options.seed, threads_, options.hooks),
        writer_(options.run, Describe(options, input.camera, detector, input.frames.size()),
                {.force = options.force, .save_segmentation = options.save_segmentation}),
        ahead_(input.frames, input.frames.size(), input.camera, tracker_, threads_),
        camera_check_(input.camera, options.config.point_features.scale),
        depth_clock_(input.camera) {}

  RunOutcome Run() {
    const int total = frames_.size();
    outcome_.sequence_frames = total;
    LearnDevice();
    if (truth_ != nullptr) {
      truth_->Begin(writer_.Path(options_.sequence.lexically_relative(options_.run)));
    }
    tied_.reserve(static_cast<std::size_t>(total));
    while (std::optional<FrameAhead> now = ahead_.Next()) {
      if (now->taken) Take(std::move(*now));
      if (options_.progress) options_.progress("slam", ahead_.given(), total);
      if (ahead_.MayGoOn() && options_.stop && options_.stop()) {
        outcome_.stopped = true;
        ahead_.Stop();
      }
    }
    Finish();
    return std::move(outcome_);
  }

 private:
  /// Learns of the device before the run.
  void LearnDevice() {
    const Config& config = options_.config;
    const bool with_planes = options_.variant != Variant::kPoints;
    const bool wanted = config.depth_registration.learn || config.rolling_shutter.learn ||
                        (with_planes && config.depth_warp.Learns());
    const int count =
        wanted && comes_again_ ? std::min(config.first_look.frames, frames_.size()) : 0;
    if (count == 0) return;
    FirstLook look =
        LookFirst(frames_, count, camera_, config, with_planes, threads_, [&](int done) {
          if (options_.progress) options_.progress("first look", done, count);
          return !options_.stop || !options_.stop();
        });
    tracker_.StartFrom(*look.tracker, std::move(look.bend));
  }

  void Take(FrameAhead ahead) {
    ++outcome_.frames;
    if (ahead.repeats) {
      StandForRepeat(ahead.frame);
    } else {
      Track(std::move(ahead));
    }
    writer_.WriteFrame(
        {frame_, report_.tracked, report_.times, StateName(report_.points), report_.refused});
    lost_.See(frame_.timestamp_s, report_.tracked);
    if (!report_.tracked) return;
    ++outcome_.tracked;
    tied_.push_back({frame_.timestamp_s, report_.reference, report_.T_cr});
  }

  void Track(FrameAhead ahead) {
    frame_ = std::move(ahead.frame);
    report_ = tracker_.Track(frame_, ahead.times);
    depth_clock_.Observe(frame_);
    if (report_.tracked && camera_check_.See(frame_) && options_.warn) {
      options_.warn(camera_check_.Warning());
    }
  }

  /// The frame before stands for one that repeats its images. The camera is where it was and
  /// sees what it saw; the map learns nothing, for the same noise twice is no second
  /// observation, and what was new then is known now.
  void StandForRepeat(const Frame& repeat) {
    frame_.timestamp_s = repeat.timestamp_s;
    for (PlaneMatch& match : frame_.plane_matches) {
      if (match.decision != PlaneDecision::kNew) continue;
      match.decision = PlaneDecision::kMatched;
      match.reason = MatchReason::kParameters;  // it lies where it is known to lie
    }
    report_.times = {};
    report_.refused = {};
    report_.keyframe = false;
    report_.points.by_relocalising = false;  // that was the frame before
  }

  void Finish() {
    tracker_.Finish(outcome_.stopped ? MappingWorker::Waiting::kDrop
                                     : MappingWorker::Waiting::kDo);
    if (truth_ != nullptr) truth_->Finish();
    outcome_.loops = tracker_.loops();
    outcome_.ended_lost = lost_.ended_lost();
    outcome_.warnings = Warnings();
    // Where the map holds the frames in the end: mapping moves what was found.
    writer_.Finish(tracker_.map(),
                   {outcome_.stopped, outcome_.warnings, tracker_.straightening(),
                    tracker_.registration(), tracker_.rolling_shutter()},
                   FollowKeyframes(tied_, tracker_.map()));
    CountMap(tracker_.map(), outcome_);
  }

  std::vector<std::string> Warnings() {
    std::vector<std::string> warnings = doubts_;
    for (std::string& left_out : ahead_.Warnings()) warnings.push_back(std::move(left_out));
    if (const int repeats = ahead_.repeats(); repeats > 0) {
      warnings.push_back(std::to_string(repeats) +
                         (repeats == 1 ? " frame repeats" : " frames repeat") +
                         " the images of the one before: taken for the same place, nothing "
                         "learned");
    }
    if (!lost_.Warning().empty()) warnings.push_back(lost_.Warning());
    // Depth of another time makes any camera look wrong: the one is said, not both.
    const std::vector<std::string> late = depth_clock_.Warnings();
    warnings.insert(warnings.end(), late.begin(), late.end());
    if (late.empty() && !camera_check_.Warning().empty()) {
      warnings.push_back(camera_check_.Warning());
    }
    if (const int unmapped = tracker_.unmapped_keyframes(); unmapped > 0 && !outcome_.stopped) {
      warnings.push_back(std::to_string(unmapped) +
                         " keyframes came too fast to be mapped on their own");
    }
    return warnings;
  }

  const RunOptions& options_;
  int threads_;
  FrameSource& frames_;
  bool comes_again_;
  Camera camera_;
  LiveTruth* truth_;
  std::vector<std::string> doubts_;
  Tracker tracker_;
  RunWriter writer_;
  FramesAhead ahead_;
  LostFrames lost_;
  CameraCheck camera_check_;
  DepthClock depth_clock_;

  Frame frame_;         ///< the last that was tracked, and ...
  TrackReport report_;  ///< ... what it came to
  std::vector<TiedPose> tied_;
  RunOutcome outcome_;
};

RunOutcome Run(LiveCamera input, const RunOptions& options, const std::string& detector,
               std::vector<std::string> doubts) {
  const auto start = std::chrono::steady_clock::now();
  cv::setNumThreads(1);  // OpenCV's own threads would only compete with ours
  RunOutcome outcome =
      SequenceRun(std::move(input), options, detector, std::move(doubts)).Run();
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
  io::RequireRecording(options.sequence);
  CameraFile camera_file = ChooseCamera(options.camera, options.sequence);
  const Camera& camera = camera_file.camera;
  SequenceReader reader(options.sequence, camera, {.prefetch = ThreadsOf(options) > 1});
  const std::string choice = DetectorChoice(options);
  std::unique_ptr<Detector> detector = MakeDetector(
      choice, options.sequence, camera, options.config.classes, options.config.yolox);

  // What is doubtful before the first frame is told with the run.
  std::vector<double> frames_s;
  frames_s.reserve(Index(reader.size()));
  for (int i = 0; i < reader.size(); ++i) frames_s.push_back(reader.entry(i).timestamp_s);
  std::vector<std::string> doubts = std::move(camera_file.warnings);
  for (const auto& more : {reader.warnings(), detector->WarningsFor(frames_s)}) {
    doubts.insert(doubts.end(), more.begin(), more.end());
  }
  return Run({reader, camera, std::move(detector), nullptr, true}, options, choice,
             std::move(doubts));
}

RunOutcome RunLive(LiveCamera live, const RunOptions& options) {
  // Boxes serve planes alone.
  if (options.variant == Variant::kPoints) live.detector = nullptr;
  const std::string detector = live.detector ? "live" : "none";
  return Run(std::move(live), options, detector, {});
}

}  // namespace slam
