#pragma once

#include <algorithm>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/pose/pose.h"
#include "eval/formats/sequence/camera.h"
#include "eval/formats/sequence/image_lists.h"
#include "eval/formats/sequence/scene_truth.h"
#include "eval/formats/stamps.h"

namespace eval {

/// All that the truth of a frame is compared with.
struct SequenceTruth {
  std::vector<ListedImage> rgb;
  std::vector<SequenceFrame> pairs;
  Trajectory poses;              ///< groundtruth.txt
  std::optional<Camera> camera;  ///< that truth is of
  std::optional<SceneTruth> scene;
  cv::Size size;
  std::string sensor;  ///< as manifest.json names it; empty when unknown

  /// Times of the colour images, rising.
  std::vector<double> frames_s() const {
    std::vector<double> stamps_s = StampsOf(rgb);
    std::sort(stamps_s.begin(), stamps_s.end());
    return stamps_s;
  }
};

}  // namespace eval
