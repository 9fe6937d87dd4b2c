#include "app/export_warning.h"

#include <nlohmann/json.hpp>

#include "io/number_text.h"
#include "io/read_file.h"

namespace app {

std::string RollingWarning(const std::filesystem::path& sequence) {
  const std::filesystem::path file = sequence / "manifest.json";
  if (!std::filesystem::is_regular_file(file)) return "";
  // What is wrong with the file is told by who reads the sequence.
  const nlohmann::json manifest = nlohmann::json::parse(io::ReadFile(file), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("exposure")) return "";
  const nlohmann::json& exposure = manifest["exposure"];
  if (!exposure.is_object() || !exposure.contains("rolling_s")) return "";
  const nlohmann::json& rolling = exposure["rolling_s"];
  if (!rolling.is_number() || rolling.get<double>() == 0) return "";
  return sequence.string() + ": colour was read over " +
         io::NumberText(1000 * rolling.get<double>()) +
         " ms (rolling shutter), and masks, boxes and poses are of the middle of it: off by "
         "some pixels where the camera moves. To train on it, record with --rolling-ms 0";
}

}  // namespace app
