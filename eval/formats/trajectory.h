#pragma once

#include <string>

#include "eval/formats/folder.h"
#include "eval/formats/pose.h"

namespace eval {

/// Reads `t tx ty tz qx qy qz qw` lines (TUM): seconds, metres, T_wc, by rising stamp. Unit
/// quaternions are normalised once more, for their last digits.
/// @param repetition  what a stamp that comes again does; recorded truth has some (TUM's fr2/desk)
Trajectory ReadTrajectory(Folder& folder, const std::string& file,
                          Severity repetition = Severity::kWarning);

/// Reads groundtruth.txt, which is optional, but not empty when it is there.
Trajectory ReadGroundtruth(Folder& folder);

}  // namespace eval
