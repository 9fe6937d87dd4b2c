#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/check/fault.h"

namespace eval {

/// A line of rgb.txt or depth.txt.
struct ListedImage {
  double stamp_s = 0;
  std::string file;  ///< relative to the folder
  int line = 0;
};

/// A colour image and the depth image that goes with it.
struct ListedPair {
  ListedImage rgb, depth;
};

/// Checks rgb.txt or depth.txt: syntax, order of stamps, existence of the files.
std::vector<ListedImage> CheckImageList(FolderCheck& check, const std::string& list);

/// Checks associations.txt against the two lists; without the file, pairs by nearest time
/// within 20 ms, as every reader does.
std::vector<ListedPair> CheckAssociations(FolderCheck& check,
                                          const std::vector<ListedImage>& rgb,
                                          const std::vector<ListedImage>& depth);

}  // namespace eval
