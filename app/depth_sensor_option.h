#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "slam/run/config.h"

namespace app {

/// --sensor: what measured the depth of a recording. `sensor` holds the default.
CLI::Option* AddSensorOption(CLI::App& command, std::string& sensor);

/// The settings for a sensor, with those of a file over them when one is named.
/// @param sensor  one of slam::DepthSensorNames()
/// @throws io::InputError of slam::ReadConfig.
slam::Config ConfigFrom(const std::string& sensor, const std::string& config_file);

}  // namespace app
