#pragma once

#include <filesystem>

#include "eval/read/pose.h"

namespace eval {

/// Reads `t tx ty tz qx qy qz qw` lines (TUM): seconds, metres, T_wc; quaternions are
/// normalised.
/// @throws InputError with file:line for a wrong number of fields, a number that is none, or a
///         quaternion without direction.
Trajectory ReadTrajectory(const std::filesystem::path& file);

}  // namespace eval
