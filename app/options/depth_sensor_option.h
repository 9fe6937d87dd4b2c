#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "slam/run/config.h"

namespace app {

/// As a default of --sensor: the recording tells it.
inline constexpr const char* kAutoSensor = "auto";

/// --sensor: what measured the depth of a recording. `sensor` holds the default; it may be
/// kAutoSensor only where that is the default.
CLI::Option* AddSensorOption(CLI::App& command, std::string& sensor);

/// The settings for a sensor, with those of a file over them when one is named.
/// @param sensor  one of slam::DepthSensorNames(); kAutoSensor is the first of them
/// @throws io::InputError of slam::ReadConfig.
slam::Config ConfigFrom(const std::string& sensor, const std::string& config_file);

/// The same for a recording, whose depth tells the sensor (slam::DepthScatter) where it is
/// kAutoSensor. Unless quiet, stderr says what it is taken for, and what its noise tells.
/// @param sequence, camera  as of slam::RunOptions
slam::Config ConfigForRecording(const std::string& sensor, const std::string& config_file,
                                const std::filesystem::path& sequence,
                                const std::string& camera, bool quiet);

}  // namespace app
