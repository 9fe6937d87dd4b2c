#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "sim/write/write_sequence.h"

namespace app {

/// Adds the options of `pas sim` that say how a scene is recorded (frames, sensor, detector,
/// size, ...) to another command, so that both record the same.
/// @param prefix  before the names `seed` and `detector`, which the command has taken itself
/// @returns what the options say of a scene, to be called once they are parsed
std::function<sim::SequenceOptions(const sim::Scene&)> AddRecordingOptions(
    CLI::App& command, const std::string& prefix);

}  // namespace app
