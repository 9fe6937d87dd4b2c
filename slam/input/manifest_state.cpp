#include "slam/input/manifest_state.h"

#include <nlohmann/json.hpp>

#include "io/read_file.h"

namespace slam {

ManifestState ReadManifestState(const std::filesystem::path& sequence, int frames) {
  const std::filesystem::path file = sequence / "manifest.json";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  const auto json = nlohmann::json::parse(io::ReadFile(file), nullptr, false);
  ManifestState state;
  if (!json.is_object()) {
    state.warnings.push_back(
        "manifest.json is no JSON object; whether the sequence is whole is not known");
    return state;
  }
  const auto complete = json.find("complete"), count = json.find("frame_count");
  if (complete != json.end() && *complete != true) {
    state.unfinished = true;
    state.warnings.push_back(
        "manifest.json does not say complete: true; the sequence was not written to its end "
        "(`pas sim --resume` does so)");
  } else if (count != json.end() && *count != frames) {
    state.warnings.push_back("manifest.json counts " + count->dump() +
                             " frames, the lists of the sequence give " +
                             std::to_string(frames));
  }
  return state;
}

}  // namespace slam
