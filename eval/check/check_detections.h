#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "eval/check/check_lists.h"
#include "eval/check/checked_json.h"
#include "eval/check/fault.h"

namespace eval {

/// Checks detections.jsonl: times of frames, in order; classes, scores in [0, 1], boxes ordered
/// and within the image.
void CheckDetections(FolderCheck& check, const std::vector<ListedImage>& rgb, cv::Size size);

/// Checks `key` as a box [x0, y0, x1, y1] in pixels, x0 < x1, y0 < y1 (equal ones, a single row
/// or column, only when `may_be_thin`), inside an image of `size` unless that is empty.
/// @returns whether it is good
bool CheckBox(const CheckedJson& record, const std::string& key, cv::Size size,
              bool may_be_thin);

}  // namespace eval
