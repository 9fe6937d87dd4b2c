#include "eval/formats/sequence/sequence.h"

#include <string>

#include "eval/formats/pose/trajectory.h"
#include "eval/formats/sequence/manifest.h"
#include "eval/formats/sequence/sequence_agreement.h"
#include "io/folder_kind.h"

namespace eval {
namespace fs = std::filesystem;

Sequence ReadSequence(const fs::path& path) {
  io::RequireSequence(path);
  Folder folder(path);
  Sequence sequence;
  sequence.folder = path;
  const Manifest manifest = ReadManifest(folder);
  sequence.synthetic = HasTruthOfFrames(folder);
  sequence.complete = manifest.complete;
  sequence.rolling_s = manifest.rolling_s;
  sequence.frames = ReadFrames(folder);
  TellFrameCount(folder, manifest, sequence.frames.size());
  if (folder.Has("camera.yaml")) sequence.camera = ReadCamera(folder);
  if (folder.Has(kTrueCamera)) sequence.true_camera = ReadTrueCamera(folder);
  if (!sequence.true_camera) sequence.true_camera = sequence.camera;
  if (folder.Has("groundtruth.txt")) sequence.groundtruth = ReadGroundtruth(folder);
  if (folder.Has("gt/scene.json")) sequence.scene = ReadSceneTruth(folder);
  if (folder.Has("gt/frames.jsonl")) sequence.frame_truth = ReadFrameTruth(folder);
  TellSequenceDisagreements(folder, sequence);
  sequence.plane_id_files = StampedFiles(path / "gt/plane_id");
  sequence.object_id_files = StampedFiles(path / "gt/object_id");
  sequence.warnings = std::move(folder.faults());
  return sequence;
}

std::optional<cv::Mat1w> ReadPlaneIds(const Sequence& sequence, double stamp_s) {
  const auto file = sequence.plane_id_files.Find(stamp_s);
  if (!file) return std::nullopt;
  const cv::Size size =
      sequence.camera ? cv::Size(sequence.camera->width, sequence.camera->height) : cv::Size();
  cv::Mat1w ids = ReadLabels(*file, {CV_16U, 1, size});
  // Neighbours mostly repeat: each id is looked up where it begins.
  int last = 0, scored_as = 0;
  for (std::uint16_t& id : ids) {
    if (id != last) {
      last = id;
      const auto found = sequence.scored_as.find(id);
      scored_as = found == sequence.scored_as.end() ? id : found->second;
      if (id != 0 && sequence.scene && sequence.scene->FindPlane(scored_as) == nullptr) {
        throw io::InputError(file->string(), "shows plane " + std::to_string(id) +
                                                 ", which is not in gt/scene.json; write image "
                                                 "and scene from the same truth");
      }
    }
    id = static_cast<std::uint16_t>(scored_as);
  }
  return ids;
}

}  // namespace eval
