#pragma once

#include <filesystem>

#include "eval/check/fault.h"

namespace eval {

/// Validates a sequence folder, file by file, against the format "Sequence". A TUM RGB-D folder
/// as downloaded (no camera.yaml, no truth images, no manifest) is valid.
CheckReport CheckSequence(const std::filesystem::path& folder);

}  // namespace eval
