#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "sim/motion/trajectory.h"
#include "sim/write/recording.h"
#include "sim/write/sequence_folder.h"
#include "sim/write/simulator.h"

namespace sim {

struct SequenceOptions {
  RigOptions rig;
  /// Poses closer in time than frames, for what moves within a frame (exposure, depth offset);
  /// empty: the trajectory itself, which is then joined by straight ways and steady turns.
  std::vector<TimedPose> path;
  int frames = 300;  ///< at least 1
  int threads = 0;   ///< 0: one a core; never changes a byte
  Existing existing = Existing::kRefuse;
  std::string version;  ///< the program's, for the manifest
  /// How the camera was moved, for the manifest: key, value.
  std::map<std::string, std::string> motion;
  std::function<void(int)> progress;  ///< frames done of this call; may be empty
};

/// manifest.json of a recording before its first frame: complete: false, and sha256 of `fixed`
/// alone (FixedFiles).
nlohmann::ordered_json PlannedManifest(const Scene& scene, const Recording& recording,
                                       const SequenceOptions& options,
                                       const std::map<std::string, std::string>& fixed);

/// Renders the scene along the scene's own motion and writes a sequence folder (formats.md)
/// with all truth. manifest.json says complete: false until the last file is there. The same
/// scene and options give the same bytes, with any number of threads, in one go or resumed.
/// @returns frames rendered now (fewer than options.frames when resumed)
/// @throws InputError for a folder that is in the way, is written by another process or cannot
///   be written, a scene without
///   room for the camera; std::invalid_argument for options out of range
int WriteSequence(const Scene& scene, const SequenceOptions& options,
                  const std::filesystem::path& folder);

/// The same for a recording that is planned already; options.frames, .path are not used.
int WriteSequence(const Scene& scene, const Recording& recording,
                  const SequenceOptions& options, const std::filesystem::path& folder);

/// The same along a given trajectory; options.frames is not used.
int WriteSequence(const Scene& scene, const std::vector<TimedPose>& trajectory,
                  const SequenceOptions& options, const std::filesystem::path& folder);

}  // namespace sim
