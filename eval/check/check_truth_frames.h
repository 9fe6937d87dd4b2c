#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "eval/check/check_camera.h"
#include "eval/check/check_lists.h"
#include "eval/check/check_scene_truth.h"
#include "eval/check/check_trajectory.h"
#include "eval/check/fault.h"

namespace eval {

/// All that the truth of a frame is compared with.
struct SequenceTruth {
  std::vector<ListedImage> rgb;
  std::vector<ListedPair> pairs;
  std::vector<CheckedPose> poses;  ///< groundtruth.txt
  std::optional<CheckedCamera> camera;
  std::optional<CheckedScene> scene;
  cv::Size size;
  std::string sensor;  ///< of manifest.json; empty when unknown
};

/// Checks gt/frames.jsonl and the id images against each other (pixel counts, visible boxes,
/// owners) and against gt/scene.json; every listed colour image has its truth.
void CheckTruthFrames(FolderCheck& check, const SequenceTruth& truth);

}  // namespace eval
