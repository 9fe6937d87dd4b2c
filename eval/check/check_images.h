#pragma once

#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/check/check_lists.h"
#include "eval/check/fault.h"

namespace eval {

/// What an image of a folder must be.
struct ImageKind {
  int depth = CV_8U;  ///< CV_8U or CV_16U
  int channels = 1;
  cv::Size size;  ///< empty: whatever the first image has
};

/// Decodes a PNG as it is stored and checks its type and size; a cut-off or broken file is a
/// fault.
/// @returns the image, or an empty one after a fault
cv::Mat CheckImage(FolderCheck& check, const std::string& file, const ImageKind& kind);

/// Checks all colour and depth images of a sequence.
/// @param size  of camera.yaml; empty without one, then the first colour image decides
/// @returns the size of the images, empty when none can be read
cv::Size CheckListedImages(FolderCheck& check, const std::vector<ListedImage>& rgb,
                           const std::vector<ListedImage>& depth, cv::Size size);

}  // namespace eval
