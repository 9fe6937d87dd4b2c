#include "eval/check/check_sequence.h"

#include "eval/check/check_deep.h"
#include "eval/check/check_detections.h"
#include "eval/check/check_image_lists.h"
#include "eval/check/check_manifest.h"
#include "eval/check/check_truth_frames.h"
#include "eval/formats/pose/trajectory.h"
#include "eval/formats/sequence/manifest.h"
#include "eval/formats/sequence/sequence_agreement.h"
#include "eval/formats/stamps.h"

namespace eval {
namespace {

// Exact truth has a pose for every frame; a motion capture system has its own times.
void CheckPoses(Folder& folder, const SequenceTruth& truth) {
  const bool exact = HasTruthOfFrames(folder);
  const std::string file = "groundtruth.txt";
  if (exact ? !folder.Require(file, "write the pose of every frame") : !folder.Has(file))
    return;
  TellFramesWithoutPose(folder, truth.frames_s(), truth.poses, exact);
}

/// The truth of a live run lists images that never were files.
bool HasImages(const std::filesystem::path& path) {
  Folder apart(path, OnFault::kCollect);  // what is wrong with the manifest is told elsewhere
  return ReadManifest(apart).images;
}

std::vector<ListedImage> ReadListedImages(Folder& folder, const std::string& list) {
  std::vector<ListedImage> images = ReadListOrPairs(folder, list);
  const std::string names_them = folder.Has(list) ? list : "associations.txt";
  if (HasImages(folder.root())) CheckListedFiles(folder, names_them, images);
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
  if (folder.Has("groundtruth.txt")) truth.poses = ReadGroundtruth(folder);
  CheckPoses(folder, truth);
  CheckDetections(folder, truth.rgb, truth.size);
  if (folder.Has("gt/scene.json")) truth.scene = ReadSceneTruth(folder);
  truth.sensor = CheckManifest(folder, static_cast<int>(truth.rgb.size()));
  if (folder.Has(kTrueCamera)) truth.camera = ReadCamera(folder, kTrueCamera);
  CheckTruthFrames(folder, truth);
  if (deep) CheckDeep(folder, truth);
  return {"sequence", std::move(folder.faults()), static_cast<int>(folder.opened().size()),
          static_cast<int>(truth.rgb.size())};
}

}  // namespace eval
