#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "app/sim/sim_arguments.h"

namespace app {

/// The options of `pas sim` that say how a scene is recorded: frames, sensor, motion, detector,
/// size ...
/// @param prefix  before the names `seed`, `sensor` and `detector`, for a command that has taken
///   them itself
void AddCaptureOptions(CLI::App& command, SimArguments& arguments, const std::string& prefix);

/// A scene and how it is to be recorded.
struct SceneRecording {
  sim::Scene scene;
  sim::SequenceOptions options;
  sim::Recording recording;
  std::vector<std::filesystem::path> inputs;  ///< the files that this was read from
};

/// The same options for another command, so that both record the same.
/// @returns reads a scene file and says what the options make of it, once they are parsed;
///   `seed` stands in for a --PREFIXseed that is not given
using ReadRecording = std::function<SceneRecording(const std::string& scene_file,
                                                   std::optional<std::uint64_t> seed)>;
ReadRecording AddRecordingOptions(CLI::App& command, const std::string& prefix);

}  // namespace app
