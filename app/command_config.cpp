#include <fmt/core.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "app/app.h"
#include "app/options/depth_sensor_option.h"
#include "slam/run/config_file.h"

namespace app {
namespace {

std::vector<std::string> LinesOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::size_t IndentOf(const std::string& line) { return line.find_first_not_of(' '); }

/// All settings, those commented out that each sensor has its own defaults of: a file of them leaves
/// what measured the depth to the recording.
std::string SettingsOfAnySensor(const std::string& config_file) {
  std::vector<std::vector<std::string>> of_sensors;
  for (const std::string& sensor : slam::DepthSensorNames())
    of_sensors.push_back(LinesOf(slam::ConfigAsYaml(ConfigFrom(sensor, config_file))));
  const std::vector<std::string>& lines = of_sensors.front();
  std::vector<bool> depends(lines.size());
  for (std::size_t i = lines.size(); i-- > 0;) {
    const bool group = i + 1 < lines.size() && IndentOf(lines[i + 1]) > IndentOf(lines[i]);
    bool all = group;
    for (std::size_t j = i + 1; j < lines.size() && IndentOf(lines[j]) > IndentOf(lines[i]);
         ++j)
      all = all && depends[j];
    depends[i] = all || std::any_of(of_sensors.begin(), of_sensors.end(),
                                    [&](const auto& other) { return other[i] != lines[i]; });
  }
  std::string text =
      "# What is commented out has a default for each sensor, here kinect1; the recording "
      "tells its sensor. `pas config --sensor\n"
      "# NAME` prints those of one sensor.\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::size_t indent = depends[i] ? IndentOf(lines[i]) : 0;
    text +=
        lines[i].substr(0, indent) + (depends[i] ? "# " : "") + lines[i].substr(indent) + "\n";
  }
  return text;
}

}  // namespace

void AddConfigCommand(CLI::App& pas, const Globals&, int& exit_code) {
  CLI::App* command = pas.add_subcommand(
      "config",
      "Print every setting of `pas slam` with its meaning, unit, domain and default, as a\n"
      "file that --config takes: pas config > mine.yaml. A file needs only the keys that it\n"
      "changes.");
  struct Arguments {
    std::string sensor = kAutoSensor, file;
  };
  const auto arguments = std::make_shared<Arguments>();
  AddSensorOption(*command, arguments->sensor);
  command->add_option("--config", arguments->file, "Settings over the defaults, YAML");
  command->callback([arguments, &exit_code] {
    fmt::print("{}", arguments->sensor == kAutoSensor
                         ? SettingsOfAnySensor(arguments->file)
                         : slam::ConfigAsYaml(ConfigFrom(arguments->sensor, arguments->file)));
    exit_code = kDone;
  });
}

}  // namespace app
