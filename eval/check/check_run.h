#pragma once

#include <filesystem>

#include "eval/check/report.h"

namespace eval {

/// Validates a run folder, file by file, against the format "Run".
CheckReport CheckRun(const std::filesystem::path& folder);

}  // namespace eval
