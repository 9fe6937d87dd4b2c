#include "eval/check/check_manifest.h"

#include <fmt/format.h>

#include <map>
#include <optional>

#include "eval/check/checked_json.h"
#include "io/input_error.h"
#include "io/sha256.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

const std::string kFile = "manifest.json";

// Nothing for a file that cannot be read.
std::optional<std::string> HashOf(const fs::path& file) {
  try {
    return io::Sha256OfFile(file);
  } catch (const io::InputError&) {
    return std::nullopt;
  }
}

// The hashes stand in "sha256" (or "files"), as an object of file -> hash.
std::optional<std::map<std::string, std::string>> Hashes(const CheckedJson& root) {
  const std::string key = root.Has("sha256") ? "sha256" : "files";
  if (!root.Has(key) || !root.value().at(key).is_object()) {
    root.ReportAt("sha256", "is missing; expected an object of file: hash",
                  "make the sequence again");
    return std::nullopt;
  }
  std::map<std::string, std::string> hashes;
  for (const auto& [file, hash] : root.value().at(key).items()) {
    if (hash.is_string()) {
      hashes[file] = hash.get<std::string>();
    } else if (hash.is_object() && hash.contains("sha256") && hash["sha256"].is_string()) {
      hashes[file] = hash["sha256"].get<std::string>();
    } else {
      root.ReportAt(key, "has no hash for " + file, "make the sequence again");
    }
  }
  return hashes;
}

// Files that the format knows, of those in the folder; whatever else lies there is ignored.
bool IsPartOfFormat(const std::string& file) {
  for (const char* name :
       {"rgb.txt", "depth.txt", "associations.txt", "groundtruth.txt", "camera.yaml",
        "detections.jsonl", "gt/scene.json", "gt/frames.jsonl"}) {
    if (file == name) return true;
  }
  for (const char* folder : {"rgb/", "depth/", "gt/plane_id/", "gt/object_id/"}) {
    if (file.rfind(folder, 0) == 0 && file.ends_with(".png")) return true;
  }
  return false;
}

void CheckHashes(FolderCheck& check, const std::map<std::string, std::string>& hashes) {
  for (const auto& [file, told] : hashes) {
    const auto hash = HashOf(check.root / file);
    if (!hash) {
      check.Add(file, 0, "is in manifest.json, but is missing", "make the sequence again");
    } else if (*hash != told) {
      check.Add(file, 0, "has changed since the sequence was written (sha256 differs)",
                "restore the file, or make the sequence again");
    }
  }
  std::set<std::string> unlisted;
  for (const auto& entry : fs::recursive_directory_iterator(check.root)) {
    if (!entry.is_regular_file()) continue;
    const std::string file = fs::relative(entry.path(), check.root).generic_string();
    if (IsPartOfFormat(file) && hashes.count(file) == 0) unlisted.insert(file);
  }
  for (const std::string& file : unlisted) {
    check.Add(file, 0, "is not in manifest.json",
              "remove the file, or make the sequence again");
  }
}

std::string Sensor(const CheckedJson& root) {
  if (!root.Has("sensor")) {
    root.ReportAt("sensor", "is missing; expected the name of the sensor",
                  "make the sequence again");
    return "";
  }
  const nlohmann::json& sensor = root.value().at("sensor");
  if (sensor.is_string()) return sensor.get<std::string>();
  for (const char* key : {"name", "kind", "model"}) {
    if (sensor.is_object() && sensor.contains(key) && sensor[key].is_string()) {
      return sensor[key].get<std::string>();
    }
  }
  return "";
}

void CheckKeys(const CheckedJson& root, int frames) {
  const auto format = root.Text("format");
  if (format && *format != "pas-sequence/1") {
    root.ReportAt("format", "is " + *format + "; expected pas-sequence/1",
                  "convert the sequence to this version of the format");
  }
  root.Text("generator");
  root.Text("version");
  root.Integer("seed");
  const auto complete = root.Flag("complete");
  if (complete && !*complete) {
    root.ReportAt("complete", "is false: the sequence was not finished",
                  "resume or make the sequence again");
  }
  const std::string key = root.Contains("frame_count") ? "frame_count" : "frames";
  const auto told = root.Integer(key);
  if (told && *told != frames) {
    root.ReportAt(key, fmt::format("is {}, but rgb.txt lists {}", *told, frames),
                  "make the sequence again");
  }
}

}  // namespace

std::string CheckManifest(FolderCheck& check, int frames) {
  std::string sensor;
  if (!check.Has(kFile)) return sensor;
  VisitJson(check, kFile, [&](const CheckedJson& root) {
    CheckKeys(root, frames);
    sensor = Sensor(root);
    if (const auto hashes = Hashes(root)) CheckHashes(check, *hashes);
  });
  return sensor;
}

}  // namespace eval
