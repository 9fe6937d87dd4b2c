#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slam {

/// One frame of a sequence: which files make it up.
struct SequenceEntry {
  double timestamp_s = 0.0;  ///< the colour image's, and so the frame's
  double depth_timestamp_s = 0.0;
  std::string rgb, depth;  ///< file names, relative to the sequence
  std::string source;      ///< "associations.txt:12", for messages
};

/// What a recording gave that is not used. Each is counted, none is silent.
struct SequenceWarnings {
  int repeated = 0;               ///< stamp equal to that of the frame before it
  int out_of_order = 0;           ///< stamp that does not fit the order of the others
  int unpaired_rgb = 0;           ///< no depth image within 20 ms
  int unpaired_depth = 0;         ///< no colour image within 20 ms
  std::vector<std::string> text;  ///< for each kind that occurred: what, and the first case
};

struct SequenceIndex {
  std::vector<SequenceEntry> entries;  ///< timestamps strictly increase
  SequenceWarnings warnings;
};

/// Lists the frames of a sequence folder (formats.md): associations.txt when it is there, else
/// rgb.txt and depth.txt paired by nearest time, one to one, nearest pairs first, strictly
/// within 20 ms (the rule of TUM's associate.py).
///
/// Stamps that repeat or go back are left out: the fewest frames whose absence makes time
/// strictly increase, the later line where two choices are equal.
/// @throws InputError with file:line for a line that cannot be understood, stamps in units
/// other
///   than seconds, a file name that leads out of the folder, a list without frames.
SequenceIndex IndexSequence(const std::filesystem::path& sequence);

}  // namespace slam
