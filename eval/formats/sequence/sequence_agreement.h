#pragma once

#include <vector>

#include "eval/formats/sequence/frame_truth.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/formats/stamps.h"

namespace eval {

/// Whether gt/ tells what the frames show: poses are then those of the frames, and matched by equal
/// stamps. Any recording may have a manifest.json, so that is no sign of it.
bool HasTruthOfFrames(const Folder& folder);

/// Tells frames that have no pose in groundtruth.txt.
/// @param exact  every frame has its pose (a simulator's); else one frame with a pose will do
void TellFramesWithoutPose(Folder& folder, const std::vector<double>& frames_s,
                           const Trajectory& truth, bool exact);

/// Tells frames that gt/frames.jsonl lacks, times of it that are no frame's, and ids of it that
/// gt/scene.json does not have.
/// @param scene  null when there is none
void TellFrameTruth(Folder& folder, const std::vector<double>& frames_s,
                    const std::vector<FrameTruth>& truth, const SceneTruth* scene);

/// All of it for a sequence as it is scored.
void TellSequenceDisagreements(Folder& folder, const Sequence& sequence);

}  // namespace eval
