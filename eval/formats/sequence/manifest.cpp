#include "eval/formats/sequence/manifest.h"

#include <fmt/format.h>

#include "eval/formats/json_record.h"

namespace eval {
namespace {

using nlohmann::json;

constexpr const char* kMakeAgain = "make the sequence again";

/// They stand in "sha256" (or "files"), as an object of file -> hash.
std::optional<std::map<std::string, std::string>> ReadHashes(const JsonRecord& root) {
  const std::string key = root.Has("sha256") ? "sha256" : "files";
  if (!root.Has(key) || !root.value().at(key).is_object()) {
    root.TellAt("sha256", "is missing; expected an object of file: hash", kMakeAgain,
                Severity::kFlaw);
    return std::nullopt;
  }
  std::map<std::string, std::string> hashes;
  for (const auto& [file, hash] : root.value().at(key).items()) {
    const json& text = hash.is_object() ? hash.value("sha256", json()) : hash;
    if (text.is_string()) {
      hashes[file] = text.get<std::string>();
    } else {
      root.TellAt(key, "has no hash for " + file, kMakeAgain, Severity::kFlaw);
    }
  }
  return hashes;
}

std::string ReadSensor(const JsonRecord& root) {
  if (!root.Has("sensor")) {
    root.TellAt("sensor", "is missing; expected the name of the sensor", kMakeAgain,
                Severity::kFlaw);
    return "";
  }
  const json& sensor = root.value().at("sensor");
  if (sensor.is_string()) return sensor.get<std::string>();
  for (const char* key : {"name", "kind", "model"}) {
    if (sensor.is_object() && sensor.contains(key) && sensor[key].is_string()) {
      return sensor[key].get<std::string>();
    }
  }
  return "";
}

double ReadRolling(const json& root) {
  const auto exposure = root.find("exposure");
  if (exposure == root.end() || !exposure->is_object()) return 0.0;
  const json rolling = exposure->value("rolling_s", json());
  return rolling.is_number() ? rolling.get<double>() : 0.0;
}

Manifest Read(const JsonRecord& root) {
  constexpr const char* kFormat = "pas-sequence/1";
  const JsonRecord expected = root.Expected();
  Manifest manifest;
  const auto format = expected.Text("format");
  manifest.known_format = format == kFormat;
  if (format && !manifest.known_format) {
    root.TellAt("format", "is " + *format + "; expected " + kFormat,
                "convert the sequence to this version of the format", Severity::kWarning);
  }
  expected.Text("generator");
  expected.Text("version");
  if (manifest.known_format) expected.Text("scene_hash");
  expected.Whole("seed");
  manifest.complete = expected.Flag("complete").value_or(true);
  if (!manifest.complete) {
    root.TellAt("complete", "is false: the sequence was not finished",
                "resume or make the sequence again", Severity::kWarning);
  }
  manifest.frame_count_key = root.Contains("frame_count") ? "frame_count" : "frames";
  manifest.frame_count = expected.Integer(manifest.frame_count_key);
  manifest.images = !root.Contains("images") || root.value().at("images") != false;
  manifest.sensor = ReadSensor(root);
  // As recorded, a `kinect1` has errors of its calibration by itself.
  manifest.sensor_as_named = !root.Has("sensor_parameters") &&
                             (!root.Has("calibration_error") || manifest.sensor == "kinect1");
  manifest.rolling_s = ReadRolling(root.value());
  manifest.sha256 = ReadHashes(root);
  return manifest;
}

}  // namespace

void TellFrameCount(Folder& folder, const Manifest& manifest, std::size_t frames) {
  if (!manifest.frame_count || *manifest.frame_count == static_cast<int>(frames)) return;
  folder.Tell(
      {"manifest.json", 0, "/" + manifest.frame_count_key,
       fmt::format("is {}, but the lists give {}", *manifest.frame_count, frames), kMakeAgain},
      Severity::kWarning);
}

Manifest ReadManifest(Folder& folder) {
  const std::string file = "manifest.json";
  Manifest manifest;
  if (!folder.Has(file)) return manifest;
  VisitJson(folder, file, [&](const JsonRecord& root) { manifest = Read(root); });
  return manifest;
}

}  // namespace eval
