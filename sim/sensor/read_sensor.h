#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "sim/sensor/sensor.h"

namespace sim {

/// A parameter of a sensor as a file may set it. Switches are 0 or 1.
struct SensorParameter {
  std::string key;
  double value = 0;
  double low = 0, high = 0;  ///< the values that are allowed
  std::string unit;          ///< may be empty
};

/// All parameters of the sensor, depth first, then those of colour ("colour_..."), in the order
/// in which docs list them.
std::vector<SensorParameter> Parameters(const Sensor& sensor);

/// A sensor from a YAML file: `base:` one of kSensorNames, optionally `name:`, and any of
/// the base's parameters.
/// @throws InputError with file:line for a missing base, an unknown key (names the known ones),
///   or a value out of range (says which)
Sensor ReadSensor(const std::filesystem::path& file);
Sensor ParseSensor(const std::string& text, const std::string& file);

/// One of our sensors by name, or the file that the text names (ends in .yaml or .yml).
/// @throws InputError for any other text
Sensor SensorByName(const std::string& text);

}  // namespace sim
