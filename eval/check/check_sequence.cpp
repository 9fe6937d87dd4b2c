#include "eval/check/check_sequence.h"

#include <fmt/format.h>

#include "eval/check/check_deep.h"
#include "eval/check/check_detections.h"
#include "eval/check/check_images.h"
#include "eval/check/check_manifest.h"
#include "eval/check/check_truth_frames.h"
#include "eval/check/checked_text.h"

namespace eval {
namespace {

// Exact truth has a pose for every frame; a motion capture system has its own times.
void CheckPosesCoverFrames(FolderCheck& check, const SequenceTruth& truth) {
  if (!check.Has("gt/frames.jsonl")) return;
  if (!check.Require("groundtruth.txt", "write the pose of every frame")) return;
  std::vector<double> stamps;
  for (const CheckedPose& pose : truth.poses) stamps.push_back(pose.stamp_s);
  for (const ListedImage& image : truth.rgb) {
    if (NearestStamp(stamps, image.stamp_s, kSameInstant_s)) continue;
    check.Add("groundtruth.txt", 0,
              fmt::format("lacks a pose for the frame {:.6f} of rgb.txt", image.stamp_s),
              "write the pose of every frame");
  }
}

}  // namespace

CheckReport CheckSequence(const std::filesystem::path& folder, bool deep) {
  FolderCheck check{folder, {}, {}, {}};
  SequenceTruth truth;
  truth.rgb = CheckImageList(check, "rgb.txt");
  const std::vector<ListedImage> depth = CheckImageList(check, "depth.txt");
  truth.pairs = CheckAssociations(check, truth.rgb, depth);
  truth.camera = CheckCamera(check);
  const cv::Size told =
      truth.camera ? cv::Size(truth.camera->width, truth.camera->height) : cv::Size();
  truth.size = CheckListedImages(check, truth.rgb, depth, told);
  if (check.Has("groundtruth.txt")) truth.poses = CheckTrajectory(check, "groundtruth.txt");
  CheckPosesCoverFrames(check, truth);
  CheckDetections(check, truth.rgb, truth.size);
  truth.scene = CheckSceneTruth(check);
  truth.sensor = CheckManifest(check, static_cast<int>(truth.rgb.size()));
  CheckTruthFrames(check, truth);
  if (deep) CheckDeep(check, truth);
  return {"sequence", std::move(check.faults), static_cast<int>(check.files.size()),
          static_cast<int>(truth.rgb.size())};
}

}  // namespace eval
