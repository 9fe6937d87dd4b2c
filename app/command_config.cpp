#include <fmt/core.h>

#include "app/app.h"
#include "app/depth_sensor_option.h"
#include "slam/run/config_file.h"

namespace app {

void AddConfigCommand(CLI::App& pas, const Globals&, int& exit_code) {
  CLI::App* command = pas.add_subcommand("config",
                                         "Print every setting of `pas slam` with its meaning, "
                                         "unit, domain and default, as a file\n"
                                         "that --config takes: pas config > mine.yaml. A file "
                                         "needs only the keys that it changes.");
  struct Arguments {
    std::string sensor = slam::DepthSensorNames().front(), file;
  };
  const auto arguments = std::make_shared<Arguments>();
  AddSensorOption(*command, arguments->sensor);
  command->add_option("--config", arguments->file, "Settings over the defaults, YAML");
  command->callback([arguments, &exit_code] {
    fmt::print("{}", slam::ConfigAsYaml(ConfigFrom(arguments->sensor, arguments->file)));
    exit_code = kDone;
  });
}

}  // namespace app
