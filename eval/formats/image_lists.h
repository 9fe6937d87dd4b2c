#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"

namespace eval {

/// A line of rgb.txt or depth.txt.
struct ListedImage {
  double stamp_s = 0.0;
  std::string file;  ///< relative to the folder
  int line = 0;
};

/// One frame: a colour image with its depth image, files relative to the sequence.
struct SequenceFrame {
  double stamp_s = 0.0;  ///< the colour image's: the frame's id
  std::string rgb;
  double depth_stamp_s = 0.0;
  std::string depth;
  int line = 0;  ///< in associations.txt; 0 without one
};

/// Reads rgb.txt or depth.txt, in the order of the file.
std::vector<ListedImage> ReadImageList(Folder& folder, const std::string& list);

/// Reads associations.txt, in the order of the file.
std::vector<SequenceFrame> ReadAssociations(Folder& folder);

/// What stands for associations.txt when there is none: for each colour image the nearest depth
/// image, if it is at most 20 ms away; the earlier one on ties. By rising stamp.
std::vector<SequenceFrame> AssociateByTime(std::vector<ListedImage> rgb,
                                           std::vector<ListedImage> depth);

/// Colour and depth image of a frame are at most this far apart (formats.md).
inline constexpr double kMaxAssociation_s = 0.02;

}  // namespace eval
