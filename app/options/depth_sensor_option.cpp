#include "app/options/depth_sensor_option.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>
#include <optional>

#include "app/console/console.h"
#include "app/options/choice_option.h"
#include "slam/run/config_file.h"
#include "slam/run/scatter_of.h"

namespace app {
namespace {

const std::string& NameOf(slam::DepthSensor sensor) {
  return slam::DepthSensorNames()[static_cast<std::size_t>(sensor)];
}

}  // namespace

CLI::Option* AddSensorOption(CLI::App& command, std::string& sensor) {
  std::vector<std::string> names = slam::DepthSensorNames();
  std::string help =
      "What measured the depth: its noise is what planes are told apart by. A --config goes "
      "over it (sensor: model: is the same)";
  if (sensor == kAutoSensor) {
    names.insert(names.begin(), kAutoSensor);
    help += ". auto: what the noise of the recording is like, kinect1 where it does not tell";
  }
  return command.add_option("--sensor", sensor, help)
      ->check(Choice(names))
      ->capture_default_str();
}

slam::Config ConfigFrom(const std::string& sensor, const std::string& config_file) {
  const std::vector<std::string>& names = slam::DepthSensorNames();
  const auto found = std::find(names.begin(), names.end(), sensor);
  const auto position = found == names.end() ? 0 : found - names.begin();
  const slam::Config config = slam::ConfigFor(static_cast<slam::DepthSensor>(position));
  return config_file.empty() ? config : slam::ReadConfig(config_file, config);
}

slam::Config ConfigForRecording(const std::string& sensor, const std::string& config_file,
                                const std::filesystem::path& sequence,
                                const std::string& camera, bool quiet) {
  if (sensor != kAutoSensor && quiet) return ConfigFrom(sensor, config_file);
  const slam::DepthScatter scatter = slam::ScatterOf(sequence, camera);
  const std::optional<slam::DepthSensor> told = scatter.TellSensor();
  const bool asked = sensor == kAutoSensor && told;
  slam::Config config = ConfigFrom(asked ? NameOf(*told) : sensor, config_file);
  if (!quiet) {
    const slam::DepthSensor used = config.sensor.sensor;
    const slam::DepthScatter::Figures seen = scatter.Measure();
    PrintAside(
        fmt::format("{}: taken for {}{} ({:.2f} of kinect1's, {:.2f} shared by neighbours)\n",
                    sequence.string(), NameOf(used),
                    !told           ? "; its noise tells no sensor"
                    : *told == used ? ", as its noise tells"
                                    : "; its noise is that of " + NameOf(*told),
                    seen.level, seen.alike));
  }
  return config;
}

}  // namespace app
