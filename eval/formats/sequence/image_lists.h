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

/// Reads rgb.txt or depth.txt, in the order of the file. Whether the images exist is not looked at.
std::vector<ListedImage> ReadImageList(Folder& folder, const std::string& list);

/// Reads associations.txt, in the order of the file.
std::vector<SequenceFrame> ReadAssociations(Folder& folder);

/// What stands for associations.txt when there is none: colour and depth images that are less than
/// kMaxAssociation_s apart are paired one to one, the nearest pairs first, as TUM's associate.py
/// does. By rising stamp. That there is no pair is a fault.
std::vector<SequenceFrame> AssociateByTime(Folder& folder, std::vector<ListedImage> rgb,
                                           std::vector<ListedImage> depth);

/// The frames of a sequence, by rising stamp, one of each: those of associations.txt when it is
/// there, else the lists paired by time.
std::vector<SequenceFrame> ReadFrames(Folder& folder);

/// Colour and depth image of a frame are less than this apart (formats.md).
inline constexpr double kMaxAssociation_s = 0.02;

}  // namespace eval
