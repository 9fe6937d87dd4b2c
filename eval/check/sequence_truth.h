#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/camera.h"
#include "eval/formats/folder.h"
#include "eval/formats/image_lists.h"
#include "eval/formats/pose.h"
#include "eval/formats/scene_truth.h"

namespace eval {

/// All that the truth of a frame is compared with.
struct SequenceTruth {
  std::vector<ListedImage> rgb;
  std::vector<SequenceFrame> pairs;
  Trajectory poses;  ///< groundtruth.txt
  std::optional<Camera> camera;
  std::optional<SceneTruth> scene;
  cv::Size size;
  std::string sensor;  ///< as manifest.json names it; empty when unknown
};

}  // namespace eval
