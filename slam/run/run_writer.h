#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "io/atomic_file.h"
#include "io/output_folder.h"
#include "slam/associate/refusals.h"
#include "slam/calibrate/registration_learner.h"
#include "slam/calibrate/rolling_learner.h"
#include "slam/calibrate/straightener.h"
#include "slam/geometry/camera.h"
#include "slam/model/frame.h"
#include "slam/model/map.h"
#include "slam/model/module_times.h"

namespace slam {

/// What run.json says of how a run was made. Equal runs have equal bytes, so nothing belongs
/// here that may differ between them: no number of threads, no output folder.
struct RunInfo {
  /// Written relative to the run folder, and absolute.
  std::filesystem::path sequence;
  int sequence_frames = 0;  ///< that the sequence has, whether or not all are run
  std::string variant;      ///< "full", "no-association", ...
  std::string association;  ///< the association rule
  std::string detector;     ///< "replay", "yolox:FILE", "live", "none"
  Camera camera;            ///< its numbers, whatever file they came from
  std::uint64_t seed = 0;
  std::string version;  ///< the program's, with the commit
  nlohmann::ordered_json options = nlohmann::ordered_json::object();  ///< see ConfigAsJson
};

/// One frame, after all stages.
struct FrameRecord {
  const Frame& frame;
  bool tracked = false;  ///< frame.T_cw is believed
  ModuleTimes times;
  const char* state = "";  ///< tracking's; written with the frame's planes when not empty
  PairRefusals refused;    ///< pairs of frame and map planes; summed in run.json
};

/// A pose of the final trajectory.
struct TimedPose {
  double timestamp_s = 0.0;
  Pose T_cw;
};

/// How a run ended.
struct RunEnd {
  bool interrupted = false;  ///< before the last frame of the sequence
  std::vector<std::string>
      warnings;  ///< for who reads the run; no paths, no times of the clock
  StraighteningReport straightening = {};
  std::optional<RegistrationEstimate> registration = {};  ///< nothing: not enough was seen
  std::optional<RollingEstimate> rolling_shutter = {};    ///< the same
};

/// Writes a run folder (formats.md) that is there whole after Finish and not at all before.
///
/// run.json has wall_time_s and peak_memory_mb, and timing.csv milliseconds: only these may
/// differ between equal runs.
class RunWriter {
 public:
  struct Options {
    bool force = false;              ///< replace an older run
    bool save_segmentation = false;  ///< segmentation/T.png
  };

  /// The refusals of a place that need no work, see io::OutputFolder. @throws InputError
  static void RequirePlace(const std::filesystem::path& folder, bool force);
  /// @throws InputError when the folder exists and force is off, or cannot be made.
  RunWriter(const std::filesystem::path& folder, RunInfo info, Options options);

  /// Frames in the order of time, lost ones as well.
  /// @throws std::invalid_argument when timestamps do not increase or a number is not finite;
  ///         InputError when the disk is full.
  void WriteFrame(const FrameRecord& record);

  /// Writes what remains and puts the folder in its place. Keyframes that were culled are left
  /// out.
  /// @param trajectory  where the map holds each tracked frame, in their order
  /// @throws std::invalid_argument unless there is one pose for each of them
  void Finish(const Map& map, const RunEnd& end, const std::vector<TimedPose>& trajectory);

  /// The place in the unfinished run of a file or folder that somebody else writes into it,
  /// before Finish.
  std::filesystem::path Path(const std::filesystem::path& relative) const {
    return output_.Path(relative);
  }

 private:
  void WriteSegmentation(const Frame& frame) const;
  nlohmann::ordered_json RunJson(const RunEnd& end) const;

  std::filesystem::path folder_;  ///< where the run will be, absolute
  io::OutputFolder output_;
  RunInfo info_;
  Options options_;
  io::AtomicFile frame_planes_, timing_;
  std::string covariances_;  ///< lines, of the same frames
  PairRefusals refused_;
  int frames_ = 0, tracked_ = 0;
  double last_s_ = 0.0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace slam
