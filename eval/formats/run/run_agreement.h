#pragma once

#include "eval/formats/run/run.h"

namespace eval {

/// Tells where the files of a run contradict each other: numbers of poses and frames, times of
/// frames, poses and keyframes, and decisions about map planes that do not exist, or not yet.
void TellRunDisagreements(Folder& folder, const Run& run);

}  // namespace eval
