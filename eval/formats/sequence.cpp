#include "eval/formats/sequence.h"

#include <algorithm>

#include "eval/formats/manifest.h"
#include "eval/formats/trajectory.h"
#include "io/folder_kind.h"

namespace eval {
namespace {

namespace fs = std::filesystem;

std::vector<SequenceFrame> ReadFrames(Folder& folder) {
  if (!folder.Has("associations.txt")) {
    const std::vector<ListedImage> depth = ReadImageList(folder, "depth.txt");
    return AssociateByTime(ReadImageList(folder, "rgb.txt"), depth);
  }
  std::vector<SequenceFrame> frames = ReadAssociations(folder);
  std::stable_sort(
      frames.begin(), frames.end(),
      [](const SequenceFrame& a, const SequenceFrame& b) { return a.stamp_s < b.stamp_s; });
  return frames;
}

}  // namespace

Sequence ReadSequence(const fs::path& path) {
  io::RequireSequence(path);
  Folder folder(path);
  Sequence sequence;
  sequence.folder = path;
  sequence.synthetic = ReadManifest(folder).synthetic;
  sequence.frames = ReadFrames(folder);
  if (folder.Has("camera.yaml")) sequence.camera = ReadCamera(folder);
  if (folder.Has("groundtruth.txt")) {
    sequence.groundtruth = ReadTrajectory(folder, "groundtruth.txt");
  }
  if (folder.Has("gt/scene.json")) sequence.scene = ReadSceneTruth(folder);
  if (folder.Has("gt/frames.jsonl")) sequence.frame_truth = ReadFrameTruth(folder);
  sequence.plane_id_files = StampedFiles(path / "gt/plane_id");
  sequence.object_id_files = StampedFiles(path / "gt/object_id");
  return sequence;
}

std::optional<cv::Mat1w> ReadPlaneIds(const Sequence& sequence, double stamp_s) {
  const auto file = sequence.plane_id_files.Find(stamp_s);
  if (!file) return std::nullopt;
  cv::Mat1w ids = ReadLabels(*file);
  if (sequence.scored_as.empty()) return ids;
  ids.forEach([&](std::uint16_t& id, const int*) {
    const auto found = sequence.scored_as.find(id);
    if (found != sequence.scored_as.end()) id = static_cast<std::uint16_t>(found->second);
  });
  return ids;
}

}  // namespace eval
