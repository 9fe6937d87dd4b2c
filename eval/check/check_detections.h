#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/sequence/image_lists.h"

namespace eval {

/// Checks detections.jsonl: times of frames, in order; classes, scores in [0, 1], boxes ordered
/// and within the image.
void CheckDetections(Folder& folder, const std::vector<ListedImage>& rgb, cv::Size size);

}  // namespace eval
