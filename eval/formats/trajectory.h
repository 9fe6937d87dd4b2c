#pragma once

#include <string>

#include "eval/formats/folder.h"
#include "eval/formats/pose.h"

namespace eval {

/// Reads `t tx ty tz qx qy qz qw` lines (TUM): seconds, metres, T_wc; quaternions are
/// normalised. That one is not of unit length, or that stamps do not increase, is a flaw.
Trajectory ReadTrajectory(Folder& folder, const std::string& file);

}  // namespace eval
