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
  /// Where each image is listed, for messages: "associations.txt:12".
  std::string rgb_source, depth_source;
};

struct SequenceIndex {
  std::vector<SequenceEntry> entries;  ///< timestamps strictly increase
  /// What is not used or looks wrong, a line a kind, with the number of cases and the first.
  std::vector<std::string> warnings;
};

/// Lists the frames of a sequence folder (formats.md): associations.txt when it is there, else
/// rgb.txt and depth.txt paired by nearest time, one to one, nearest pairs first, strictly
/// within 20 ms (the rule of TUM's associate.py). Lines are sorted by time, of those with one time
/// the first counts, and images without a partner are left out; each is counted in a warning. Pairs of associations.txt that are farther apart than that, or that
/// rgb.txt and depth.txt do not list, are used and counted in a warning.
/// @throws InputError with file:line for a line that cannot be understood, stamps in units other
///   than seconds, a file name that leads out of the folder, a list without frames.
SequenceIndex IndexSequence(const std::filesystem::path& sequence);

}  // namespace slam
