#include "eval/formats/run/run.h"

#include <fmt/format.h>

#include <system_error>

#include "eval/formats/pose/trajectory.h"
#include "eval/formats/run/run_agreement.h"
#include "eval/formats/sequence/images.h"
#include "io/folder_kind.h"
#include "io/path_type.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

}  // namespace

Run ReadRun(Folder& folder) {
  const auto expects = [&](const char* file) {
    return folder.Require(file, kRunAgain, Severity::kFlaw);
  };
  const std::string poses = "trajectory.txt", keyframes = "keyframes.txt";
  const std::string covariances = "trajectory_covariance.txt";
  Run run;
  run.folder = folder.root();
  run.info = ReadRunInfo(folder);
  if (folder.Require(poses, kRunAgain)) {
    run.trajectory = ReadTrajectory(folder, poses, {Severity::kWarning, Severity::kFatal});
  }
  if (folder.Has(covariances)) run.covariances = ReadPoseCovariances(folder, covariances);
  if (expects(keyframes.c_str())) run.keyframes = ReadTrajectory(folder, keyframes);
  if (expects("map.json")) {
    auto map = ReadRunMap(folder);
    run.has_map = map.has_value();
    if (map) run.map = std::move(*map);
  }
  run.has_planes = expects("frame_planes.jsonl");
  if (run.has_planes) run.frames = ReadRunFrames(folder);
  if (expects("timing.csv")) run.timing = ReadTiming(folder);
  run.segmentation_files = StampedFiles(folder.root() / "segmentation");
  TellRunDisagreements(folder, run);
  return run;
}

Run ReadRun(const fs::path& path) {
  io::RequireRun(path);
  Folder folder(path);
  Run run = ReadRun(folder);
  run.warnings = std::move(folder.faults());
  return run;
}

Run RunOfLabels(const fs::path& folder) {
  if (io::TypeAt(folder) != fs::file_type::directory) {
    throw io::InputError(folder.string(),
                         "is no folder, expected one of label images, "
                         "TIMESTAMP.png");
  }
  Run run;
  run.folder = folder;
  run.segmentation_files = StampedFiles(folder);
  if (run.segmentation_files.empty()) {
    throw io::InputError(
        folder.string(),
        "has no label image; write TIMESTAMP.png for each frame, 8 or 16 bits, "
        "a number for each plane and 0 for none");
  }
  return run;
}

fs::path SequenceOf(const Run& run) {
  if (!io::Exists(run.folder / "run.json")) {
    throw io::InputError(
        run.folder.string(),
        "has no run.json, which would name the sequence; name it with --truth");
  }
  const fs::path written = run.info.sequence;
  const fs::path here = fs::absolute(run.folder).lexically_normal() / "";
  const fs::path above = here.parent_path().parent_path();
  std::vector<fs::path> places;
  if (!written.empty()) places = {here / written, above / written, written};
  if (!run.info.sequence_absolute.empty()) places.emplace_back(run.info.sequence_absolute);
  std::string tried;
  for (const fs::path& place : places) {
    std::error_code ignored;
    if (fs::is_directory(place, ignored)) return fs::canonical(place);
    if (tried.find(fmt::format("\"{}\"", place.string())) != std::string::npos) continue;
    tried += (tried.empty() ? "\"" : ", \"") + place.string() + "\"";
  }
  throw io::InputError(
      (run.folder / "run.json").string(),
      "sequence: " + (tried.empty() ? "is empty" : "found no folder " + tried) +
          "; name it with --truth");
}

std::optional<cv::Mat1w> ReadSegmentation(const Run& run, double stamp_s) {
  const auto file = run.segmentation_files.Find(stamp_s);
  if (!file) return std::nullopt;
  return ReadLabels(*file, {run.has_planes ? CV_8U : kAnyDepth, 1, {}});
}

}  // namespace eval
