#include "eval/read/run.h"

#include <algorithm>
#include <limits>

#include "eval/read/sequence.h"
#include "eval/read/trajectory_file.h"
#include "io/input_error.h"
#include "io/json_field.h"
#include "io/text_table.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

std::optional<double> FirstNumber(const io::JsonField& root,
                                  std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const auto field = root.Find(key)) return field->Number();
  }
  return std::nullopt;
}

RunInfo ReadRunInfo(const fs::path& file) {
  const nlohmann::json json = io::ReadJson(file, "it is needed to know what was run");
  const io::JsonField root(json, file.string());
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
      throw io::InputError(file.string(), "two poses for the frame at " +
                                              std::to_string(trajectory[i].stamp_s) +
                                              " s; write one line per tracked frame");
    }
  }
}

}  // namespace

Timing ReadTiming(const fs::path& file) {
  const std::vector<io::TextRecord> records = io::ReadCommaRecords(file);
  if (records.empty() || records.front().fields.front() != "timestamp") {
    throw io::InputError(io::Where(file, 1), "expected a header \"timestamp,<module>,...\"");
  }
  Timing timing;
  const std::vector<std::string>& header = records.front().fields;
  timing.modules.assign(header.begin() + 1, header.end());
  for (auto record = records.begin() + 1; record != records.end(); ++record) {
    if (record->fields.size() != header.size()) {
      throw io::InputError(record->where, "expected " + std::to_string(header.size()) +
                                              " fields as in the header, found " +
                                              std::to_string(record->fields.size()));
    }
    timing.stamps_s.push_back(record->Number(0, "timestamp"));
    std::vector<double> row;
    for (std::size_t i = 1; i < header.size(); ++i) {
      const bool ran = !record->fields[i].empty();
      row.push_back(ran ? record->Number(i, header[i])
                        : std::numeric_limits<double>::quiet_NaN());
    }
    timing.rows_ms.push_back(std::move(row));
  }
  return timing;
}

Run ReadRun(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw io::InputError(folder.string(), "there is no such folder");
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
  throw io::InputError((run.folder / "run.json").string(),
                       "sequence: found no folder \"" + written.string() + "\" nor \"" +
                           beside.string() + "\"; name it with --truth");
}

std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s) {
  const auto file = run.segmentation_files.Find(stamp_s);
  if (!file) return std::nullopt;
  return ReadLabels(*file);
}

}  // namespace eval
