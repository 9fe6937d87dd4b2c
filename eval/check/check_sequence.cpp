#include "eval/check/check_sequence.h"

#include <fmt/format.h>

#include "eval/check/check_deep.h"
#include "eval/check/check_detections.h"
#include "eval/check/check_image_lists.h"
#include "eval/check/check_manifest.h"
#include "eval/check/check_truth_frames.h"
#include "eval/formats/manifest.h"
#include "eval/formats/stamps.h"
#include "eval/formats/trajectory.h"

namespace eval {
namespace {

// Exact truth has a pose for every frame; a motion capture system has its own times.
void CheckPosesCoverFrames(Folder& folder, const SequenceTruth& truth) {
  if (!folder.Has("gt/frames.jsonl")) return;
  if (!folder.Require("groundtruth.txt", "write the pose of every frame")) return;
  const std::vector<double> stamps_s = StampsOf(truth.poses);
  for (const ListedImage& image : truth.rgb) {
    if (NearestStamp(stamps_s, image.stamp_s, kSameInstant_s)) continue;
    folder.Tell("groundtruth.txt", 0,
                fmt::format("lacks a pose for the frame {:.6f} of rgb.txt", image.stamp_s),
                "write the pose of every frame");
  }
}

/// The truth of a live run lists images that never were files.
bool HasImages(const std::filesystem::path& path) {
  Folder apart(path, OnFault::kCollect);  // what is wrong with the manifest is told elsewhere
  return ReadManifest(apart).images;
}

std::vector<ListedImage> ReadListedImages(Folder& folder, const std::string& list) {
  std::vector<ListedImage> images = ReadImageList(folder, list);
  if (HasImages(folder.root())) CheckListedFiles(folder, list, images);
  return images;
}

}  // namespace

CheckReport CheckSequence(const std::filesystem::path& path, bool deep) {
  Folder folder(path, OnFault::kCollect);
  SequenceTruth truth;
  truth.rgb = ReadListedImages(folder, "rgb.txt");
  const std::vector<ListedImage> depth = ReadListedImages(folder, "depth.txt");
  truth.pairs = CheckAssociations(folder, truth.rgb, depth);
  if (folder.Has("camera.yaml")) truth.camera = ReadCamera(folder);
  const cv::Size told =
      truth.camera ? cv::Size(truth.camera->width, truth.camera->height) : cv::Size();
  truth.size = CheckListedImages(folder, truth.rgb, depth, told);
  if (folder.Has("groundtruth.txt")) truth.poses = ReadTrajectory(folder, "groundtruth.txt");
  CheckPosesCoverFrames(folder, truth);
  CheckDetections(folder, truth.rgb, truth.size);
  if (folder.Has("gt/scene.json")) truth.scene = ReadSceneTruth(folder);
  truth.sensor = CheckManifest(folder, static_cast<int>(truth.rgb.size()));
  CheckTruthFrames(folder, truth);
  if (deep) CheckDeep(folder, truth);
  return {"sequence", std::move(folder.faults()), static_cast<int>(folder.opened().size()),
          static_cast<int>(truth.rgb.size())};
}

}  // namespace eval
