#include "eval/formats/run/run_info.h"

#include <fmt/format.h>

#include <cmath>

#include "eval/formats/json_record.h"

namespace eval {
namespace {

/// A figure that other systems write under other names; `key` is what all of them begin with.
std::optional<double> Figure(const JsonRecord& root, const std::string& key,
                             const std::string& meaning,
                             std::initializer_list<const char*> names) {
  for (const char* name : names) {
    if (root.Has(name)) return root.Number(name, io::Interval("[0, inf)"));
  }
  root.TellAt(key, "is missing; expected " + meaning, kRunAgain, Severity::kFlaw);
  return std::nullopt;
}

std::string OptionalText(const JsonRecord& record, const char* key) {
  return record.Text(key).value_or("");
}

/// `pas slam` tells its camera among the options, others may do so beside them.
std::string CameraNameOf(const nlohmann::json& root) {
  const nlohmann::json options = root.value("options", nlohmann::json());
  for (const nlohmann::json& place : {root, options}) {
    if (!place.is_object() || !place.contains("camera")) continue;
    if (place["camera"].is_string()) return place["camera"].get<std::string>();
  }
  return "";
}

/// What is read into nothing is in no figure; a wrong one is told.
void CheckWhatNobodyReads(const JsonRecord& root) {
  const JsonRecord expected = root.Expected(), extra = root.Extra();
  for (const char* key : {"association", "detector", "version"}) expected.Text(key);
  constexpr double kSeeds = 0x1p64;
  const auto seed = expected.Whole("seed");
  if (seed && !(std::abs(*seed) < kSeeds)) {
    root.TellAt("seed", fmt::format("is {}; expected a whole number of 64 bits", *seed),
                kRunAgain, Severity::kFlaw);
  }
  const auto refused = extra.Object("refused_pairs");
  if (!refused) return;
  for (const auto& entry : refused->value().items()) {
    if (refused->Whole(entry.key())) refused->Number(entry.key(), io::Interval("[0, 1e18)"));
  }
}

RunInfo ReadInfo(const JsonRecord& root) {
  root.Format("pas-run/1");
  const JsonRecord expected = root.Expected(), extra = root.Extra();
  RunInfo info;
  info.sequence = OptionalText(root, "sequence");
  info.sequence_absolute = OptionalText(extra, "sequence_absolute");
  info.variant = OptionalText(expected, "variant");
  CheckWhatNobodyReads(root);
  info.camera_name = CameraNameOf(root.value());
  const bool has_numbers = root.Has("camera") && !root.value()["camera"].is_string();
  const auto camera = has_numbers ? extra.Object("camera") : std::nullopt;
  if (camera) info.camera = ReadCamera(camera->Expected());
  if (!root.Has("options")) {
    root.TellAt("options", "is missing; expected the options of the run", kRunAgain,
                Severity::kFlaw);
  }
  info.frames = expected.Integer("frames", 0);
  info.tracked = expected.Integer("tracked");
  info.interrupted = extra.Flag("interrupted").value_or(false);
  info.sequence_frames = extra.Integer("sequence_frames", 0);
  if (info.frames && info.sequence_frames && *info.sequence_frames < *info.frames) {
    root.TellAt("sequence_frames",
                fmt::format("is {}, but the run has {} frames of them", *info.sequence_frames,
                            *info.frames),
                kRunAgain, Severity::kWarning);
  }
  expected.Integer("lost", 0);
  if (info.frames && info.tracked && !(*info.tracked >= 0 && *info.tracked <= *info.frames)) {
    root.TellAt("tracked", fmt::format("is {} of {} frames", *info.tracked, *info.frames),
                kRunAgain, Severity::kWarning);
  }
  Figure(root, "wall", "the wall time", {"wall_time_s", "wall_s"});
  info.peak_memory_mb = Figure(root, "peak", "the peak memory",
                               {"peak_memory_mb", "peak_rss_mb", "peak_memory_mib"});
  return info;
}

}  // namespace

RunInfo ReadRunInfo(Folder& folder) {
  const std::string file = "run.json";
  RunInfo info;
  if (!folder.Require(file, "every run has it, to tell what was run; run the SLAM system again",
                      Severity::kFlaw)) {
    return info;
  }
  VisitJson(folder, file, [&](const JsonRecord& root) { info = ReadInfo(root); });
  return info;
}

}  // namespace eval
