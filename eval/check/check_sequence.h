#pragma once

#include <filesystem>

#include "eval/check/report.h"

namespace eval {

/// Validates a sequence folder, file by file, against the format "Sequence". A TUM RGB-D folder
/// as downloaded (no camera.yaml, no truth images, no manifest) is valid.
/// @param deep  also compare frames with each other and ids with the faces (check_deep.h)
CheckReport CheckSequence(const std::filesystem::path& folder, bool deep = false);

}  // namespace eval
