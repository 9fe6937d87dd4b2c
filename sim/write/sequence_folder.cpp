#include "sim/write/sequence_folder.h"

#include <system_error>

#include "io/atomic_file.h"
#include "io/input_error.h"
#include "io/read_file.h"

namespace sim {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

void MakeFolders(const fs::path& folder) {
  for (const char* name : {"rgb", "depth", "gt/plane_id", "gt/object_id"}) {
    std::error_code error;
    fs::create_directories(folder / name, error);
    if (error) {
      throw io::InputError(
          (folder / name).string(),
          "this folder cannot be made: " + error.message() + "; choose another output folder");
    }
  }
}

void RemoveUnfinished(const fs::path& folder) {
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == io::kUnfinishedSuffix) fs::remove(entry.path());
  }
}

/// True when there are only folders and perhaps an unfinished manifest: what a run leaves that
/// was killed before the manifest was there.
bool HoldsNothing(const fs::path& folder) {
  const fs::path unfinished = std::string("manifest.json") + io::kUnfinishedSuffix;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory() && entry.path() != folder / unfinished) return false;
  }
  return true;
}

/// Removes a sequence but for its manifest, which says incomplete first: after a kill half way
/// nothing looks whole, and the folder is still known for a sequence's.
void RemoveOld(const fs::path& folder, Json manifest) {
  manifest["complete"] = false;
  WriteManifest(folder, manifest);
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().filename() != "manifest.json") fs::remove_all(entry.path());
  }
}

/// @throws InputError unless `old`, begun or finished, was made with the plan's options.
void RequireSamePlan(const fs::path& folder, const Json& old, const Json& plan) {
  const auto refuse = [&](const std::string& key, const Json& was, const Json& is) {
    throw io::InputError(
        (folder / "manifest.json").string(),
        "cannot resume: " + key + " was " + was.dump() + ", now it is " + is.dump() +
            "; repeat the first command's options, or use --force to start again");
  };
  const auto value = [](const Json& json, const std::string& key) {
    return json.contains(key) ? json.at(key) : Json();
  };
  // What is plain in one of the two has no key there.
  Json all = old;
  all.update(plan);
  for (const auto& entry : all.items()) {
    const std::string& key = entry.key();
    if (key == "complete" || key == "sha256") continue;
    if (value(old, key) != value(plan, key)) refuse(key, value(old, key), value(plan, key));
  }
  for (const auto& [file, sum] : plan.at("sha256").items()) {
    const Json was = value(value(old, "sha256"), file);
    if (was != sum) refuse("the content of " + file, was, sum);
  }
}

}  // namespace

std::optional<Json> ReadManifest(const fs::path& folder) {
  if (!fs::exists(folder / "manifest.json")) return std::nullopt;
  Json manifest = Json::parse(io::ReadFile(folder / "manifest.json"), nullptr, false);
  if (!manifest.is_object() || !manifest.contains("format") ||
      manifest["format"] != "pas-sequence/1") {
    return std::nullopt;
  }
  return manifest;
}

void WriteManifest(const fs::path& folder, const Json& manifest) {
  io::WriteFile(folder / "manifest.json", manifest.dump(1) + "\n");
}

bool PrepareFolder(const fs::path& folder, const Json& plan, Existing existing) {
  const bool empty =
      existing == Existing::kRefuse ? fs::is_empty(folder) : HoldsNothing(folder);
  const std::optional<Json> old = empty ? std::nullopt : ReadManifest(folder);
  if (!empty && existing == Existing::kRefuse) {
    throw io::InputError(folder.string(),
                         "exists already; use --force to replace it, --resume to finish an "
                         "interrupted run, or name another folder");
  }
  if (!empty && !old) {
    throw io::InputError(
        folder.string(),
        "exists and has no manifest.json of a simulated sequence, so it is left "
        "alone; remove it yourself or name another folder");
  }
  if (!empty && existing == Existing::kReplace) RemoveOld(folder, *old);
  const bool resumed = !empty && existing == Existing::kResume;
  if (resumed) {
    RequireSamePlan(folder, *old, plan);
    if (old->value("complete", false)) return true;
    RemoveUnfinished(folder);
  }
  MakeFolders(folder);
  if (!resumed) WriteManifest(folder, plan);
  return false;
}

}  // namespace sim
