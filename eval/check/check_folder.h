#pragma once

#include <filesystem>

#include "eval/check/fault.h"

namespace eval {

/// Validates a sequence or a run, whichever the folder holds: a run has run.json (or a
/// trajectory or planes of its own), a sequence has manifest.json, rgb.txt or depth.txt. A
/// folder that is neither is a fault of its own.
CheckReport CheckFolder(const std::filesystem::path& folder);

}  // namespace eval
