#pragma once

#include <filesystem>

#include "eval/check/report.h"

namespace eval {

/// Validates a sequence or a run, whichever the folder holds: a run has run.json (or a
/// trajectory or planes of its own), a sequence has manifest.json, rgb.txt or depth.txt. A
/// folder that is neither is a fault of its own.
/// @param deep  also compare frames with each other and ids with the faces (check_deep.h)
CheckReport CheckFolder(const std::filesystem::path& folder, bool deep = false);

}  // namespace eval
