#include "eval/read/run.h"

#include <algorithm>
#include <limits>

#include "eval/read/input_error.h"
#include "eval/read/json_fields.h"
#include "eval/read/sequence.h"
#include "eval/read/text_table.h"
#include "eval/read/trajectory_file.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

std::optional<double> FirstNumber(const JsonField& root,
                                  std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto field = root.Find(key)) return field->Number();
  }
  return std::nullopt;
}

RunInfo ReadRunInfo(const fs::path& file) {
  const nlohmann::json json = ParseJson(ReadWholeFile(file, "to know what was run"), file);
  const JsonField root(json, file.string());
  if (root["format"].Text() != "pas-run/1") root["format"].Fail("\"pas-run/1\"");
  RunInfo info;
  info.sequence = root["sequence"].Text();
  const auto text = [&](const char* key) {
    const auto field = root.Find(key);
    return field ? field->Text() : std::string();
  };
  info.variant = text("variant");
  info.detector = text("detector");
  info.version = text("version");
  if (const auto field = root.Find("frames")) info.frames = field->Integer();
  if (const auto field = root.Find("tracked")) info.tracked = field->Integer();
  info.wall_time_s = FirstNumber(root, {"wall_time_s", "wall_s"});
  info.peak_memory_mb = FirstNumber(root, {"peak_memory_mb", "peak_rss_mb", "peak_memory_mib"});
  return info;
}

void SortByStamp(Trajectory& trajectory, const fs::path& file) {
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_s < b.stamp_s; });
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    if (trajectory[i].stamp_s <= trajectory[i - 1].stamp_s + kSameStamp_s) {
      throw InputError(file.string(), "two poses for the frame at " +
                                          std::to_string(trajectory[i].stamp_s) +
                                          " s; write one line per tracked frame");
    }
  }
}

}  // namespace

Timing ReadTiming(const fs::path& file) {
  const std::vector<TextLine> lines = ReadTextTable(file, ',');
  if (lines.empty() || lines.front().fields.front() != "timestamp") {
    throw InputError(Where(file, 1), "expected a header \"timestamp,<module>,...\"");
  }
  Timing timing;
  const std::vector<std::string>& header = lines.front().fields;
  timing.modules.assign(header.begin() + 1, header.end());
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    if (line->fields.size() != header.size()) {
      throw InputError(Where(file, line->number), "expected " + std::to_string(header.size()) +
                                                      " fields as in the header, found " +
                                                      std::to_string(line->fields.size()));
    }
    timing.stamps_s.push_back(ParseNumber(line->fields[0], "timestamp", file, line->number));
    std::vector<double> row;
    for (std::size_t i = 1; i < header.size(); ++i) {
      const std::string& field = line->fields[i];
      row.push_back(field.empty() ? std::numeric_limits<double>::quiet_NaN()
                                  : ParseNumber(field, header[i], file, line->number));
    }
    timing.rows_ms.push_back(std::move(row));
  }
  return timing;
}

Run ReadRun(const fs::path& folder) {
  if (!fs::is_directory(folder)) throw InputError(folder.string(), "there is no such folder");
  Run run;
  run.folder = folder;
  run.info = ReadRunInfo(folder / "run.json");
  run.trajectory = ReadTrajectory(folder / "trajectory.txt");
  SortByStamp(run.trajectory, folder / "trajectory.txt");
  if (fs::exists(folder / "keyframes.txt")) {
    run.keyframes = ReadTrajectory(folder / "keyframes.txt");
  }
  run.has_planes = fs::exists(folder / "frame_planes.jsonl");
  if (run.has_planes) run.frames = ReadRunFrames(folder / "frame_planes.jsonl");
  run.has_map = fs::exists(folder / "map.json");
  if (run.has_map) run.map = ReadRunMap(folder / "map.json");
  if (fs::exists(folder / "timing.csv")) run.timing = ReadTiming(folder / "timing.csv");
  run.segmentation_files = StampedFiles(folder / "segmentation");
  return run;
}

fs::path SequenceOf(const Run& run) {
  const fs::path written = run.info.sequence;
  const fs::path beside = run.folder / written;
  for (const fs::path& candidate : {written, beside}) {
    std::error_code ignored;
    if (!written.empty() && fs::is_directory(candidate, ignored)) return candidate;
  }
  throw InputError((run.folder / "run.json").string(),
                   "sequence: found no folder \"" + written.string() + "\" nor \"" +
                       beside.string() + "\"; name it with --truth");
}

std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s) {
  const auto file = run.segmentation_files.Find(stamp_s);
  if (!file) return std::nullopt;
  return ReadLabels(*file);
}

}  // namespace eval
