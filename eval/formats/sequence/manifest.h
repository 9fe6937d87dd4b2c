#pragma once

#include <map>
#include <optional>
#include <string>

#include "eval/formats/folder.h"

namespace eval {

/// manifest.json: who made the sequence, and of what files it consists.
struct Manifest {
  bool known_format = false;    ///< "pas-sequence/1"
  bool complete = true;         ///< false: it says that it was not finished
  bool images = true;           ///< false: of a live run, whose images never were files
  std::string sensor;           ///< empty when it does not tell
  bool sensor_as_named = true;  ///< no parameter of it was set to something else
  double rolling_s = 0.0;  ///< from the first row of a colour image to the last; 0: not told
  std::optional<int> frame_count;                            ///< colour images
  std::string frame_count_key;                               ///< the key it stands under
  std::optional<std::map<std::string, std::string>> sha256;  ///< by file
};

/// Reads manifest.json. Without the file nothing is told in the manifest.
Manifest ReadManifest(Folder& folder);

/// Tells a frame count that is not that of the lists.
void TellFrameCount(Folder& folder, const Manifest& manifest, std::size_t frames);

}  // namespace eval
