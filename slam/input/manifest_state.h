#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace slam {

/// What manifest.json says of how whole a sequence is.
struct ManifestState {
  bool unfinished = false;  ///< it says complete: false
  std::vector<std::string>
      warnings;  ///< a line a doubt; empty when there is none, or no manifest
};

/// @param frames  that the lists of the sequence give
ManifestState ReadManifestState(const std::filesystem::path& sequence, int frames);

}  // namespace slam
