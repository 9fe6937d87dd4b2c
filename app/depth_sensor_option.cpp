#include "app/depth_sensor_option.h"

#include <algorithm>

#include "slam/run/config_file.h"

namespace app {

CLI::Option* AddSensorOption(CLI::App& command, std::string& sensor) {
  return command
      .add_option("--sensor", sensor,
                  "What measured the depth: its noise is what planes are told apart by. A "
                  "--config goes over it (sensor: model: is the same)")
      ->check(CLI::IsMember(slam::DepthSensorNames()))
      ->capture_default_str();
}

slam::Config ConfigFrom(const std::string& sensor, const std::string& config_file) {
  const std::vector<std::string>& names = slam::DepthSensorNames();
  const auto position = std::find(names.begin(), names.end(), sensor) - names.begin();
  const slam::Config config = slam::ConfigFor(static_cast<slam::DepthSensor>(position));
  return config_file.empty() ? config : slam::ReadConfig(config_file, config);
}

}  // namespace app
