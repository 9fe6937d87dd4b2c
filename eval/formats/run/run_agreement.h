#pragma once

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"

namespace eval {

/// Tells where the files of a run contradict each other: numbers of poses and frames, times of
/// frames, poses and keyframes, and decisions about map planes that do not exist, or not yet.
void TellRunDisagreements(Folder& folder, const Run& run);

/// Refuses a run of another sequence by the times of its poses and of its lines of planes.
/// @throws InputError if one is of no frame of a synthetic sequence, or none of any frame of a
///   recording
void RequireRunOf(const Sequence& sequence, const Run& run);

}  // namespace eval
