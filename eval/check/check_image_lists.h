#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/sequence/image_lists.h"

namespace eval {

/// Reads rgb.txt or depth.txt; where there is none, what associations.txt pairs: no reader needs a
/// list beside it.
std::vector<ListedImage> ReadListOrPairs(Folder& folder, const std::string& list);

/// Checks rgb.txt or depth.txt: every image exists, inside the folder.
void CheckListedFiles(Folder& folder, const std::string& list,
                      const std::vector<ListedImage>& images);

/// Checks all colour and depth images of a sequence.
/// @param size  of camera.yaml; empty without one, then the first colour image decides
/// @returns the size of the images, empty when none can be read
cv::Size CheckListedImages(Folder& folder, const std::vector<ListedImage>& rgb,
                           const std::vector<ListedImage>& depth, cv::Size size);

/// Reads associations.txt and checks it against the two lists; without the file, pairs by
/// nearest time within 20 ms, as every reader does.
std::vector<SequenceFrame> CheckAssociations(Folder& folder,
                                             const std::vector<ListedImage>& rgb,
                                             const std::vector<ListedImage>& depth);

}  // namespace eval
