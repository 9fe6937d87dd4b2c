#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "slam/input/frame_source.h"
#include "slam/run/config.h"
#include "slam/run/tracker.h"

namespace slam {

/// Told after each frame: which pass over the frames it is ("first look"), and how many of its
/// frames are done.
using TellPass = std::function<void(const char* pass, int done, int total)>;

/// One run of the system over a recorded sequence.
struct RunOptions {
  std::filesystem::path sequence;
  std::filesystem::path run;  ///< folder to write
  Variant variant = Variant::kFull;
  std::string detector;  ///< see MakeDetector; empty: replay when the sequence has boxes
  std::string camera;    ///< tum1, tum2, tum3, a file; empty: the sequence's camera.yaml
  Config config;
  std::uint64_t seed = 0;  ///< of RANSAC for the edge lines of planes
  int threads = 0;         ///< 0: one a core; never changes a byte of the result
  bool save_segmentation = false;
  bool force = false;   ///< replace an older run
  std::string version;  ///< the program's, for run.json
  TellPass progress;    ///< of "first look", where there is one, and "slam"; may be empty
  /// Told at once what makes it useless to go on: the camera is not what the file says. The
  /// outcome's warnings say it again with the latest figures. May be empty.
  std::function<void(const std::string&)> warn;
  /// Asked after each frame. When true no other is begun: the run ends with the next one, which was
  /// begun meanwhile, and is written. May be empty.
  std::function<bool()> stop;
  TrackerHooks hooks;  ///< for tests and benches
};

struct RunOutcome {
  int sequence_frames = 0;  ///< that there are, those after a stop too
  int frames = 0, tracked = 0;
  int keyframes = 0, map_points = 0, map_planes = 0, loops = 0;
  bool stopped = false;     ///< before the last frame
  bool ended_lost = false;  ///< the last frame that was run is not tracked
  double wall_time_s = 0.0;
  std::vector<std::string> warnings;  ///< what the sequence gave that was not used
};

/// "full", "no-association", ...
const char* VariantName(Variant variant);
/// @throws InputError listing the variants.
Variant VariantOf(const std::string& name);

/// Writes what a live recording is to be scored against beside the run, which never reads it.
class LiveTruth {
 public:
  virtual ~LiveTruth() = default;
  /// Before the first frame is read.
  /// @param folder  to be made, inside the unfinished run: options.sequence once that is done
  virtual void Begin(const std::filesystem::path& folder) = 0;
  /// After the last frame that is read.
  virtual void Finish() = 0;
};

/// Where a run gets its frames, when that is no folder.
struct LiveCamera {
  FrameSource& frames;
  Camera camera;
  std::unique_ptr<Detector> detector;  ///< null: no detections
  LiveTruth* truth = nullptr;          ///< null: none is written
  bool comes_again = false;  ///< the frames may be read twice: once for a first look at them
};

/// Runs PAS-SLAM over the sequence and writes the run folder (formats.md), whole or not at all.
/// Truth is never read. The same options give the same bytes, apart from the times; not so
/// with config.async_mapping. There, keyframes that wait for mapping at the end are mapped
/// first, unless the run was stopped.
/// @throws InputError for bad input.
RunOutcome RunSequence(const RunOptions& options);

/// The same on frames that never were files. A frame that is not later than the one before is
/// left out and counted in a warning, numbers in depth that cannot be are no measurement, and
/// an image of another size is refused. options.sequence is only written into run.json (with
/// live.truth it is the folder of the run in which that is written), options.camera and .detector are not used. Equal frames and detections give the bytes that
/// RunSequence gives, run.json's paths apart.
RunOutcome RunLive(LiveCamera live, const RunOptions& options);

}  // namespace slam
