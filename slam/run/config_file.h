#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "slam/run/config.h"

namespace slam {

/// Reads settings over `config` (the defaults) from a YAML file: a section a stage, angles in
/// degrees (keys in _deg). Keys that are absent keep their value; `sensor: model:`
/// chooses the defaults that follow from the sensor.
/// @throws InputError with file:line for an unknown key (listing the legal ones), a wrong type,
///         a value outside its domain, settings that contradict each other.
Config ReadConfig(const std::filesystem::path& file, Config config = {});

/// Every key with its value, in the file's structure and units; for run.json.
nlohmann::ordered_json ConfigAsJson(const Config& config);

/// A file that ReadConfig takes to exactly these settings, every key with its value and a
/// comment: meaning, unit, domain, and the default for the sensor that the file names.
std::string ConfigAsYaml(const Config& config);

}  // namespace slam
