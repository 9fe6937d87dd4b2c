#pragma once

#include "eval/check/sequence_truth.h"

namespace eval {

/// Checks gt/frames.jsonl and the id images against each other (pixel counts, visible boxes,
/// owners) and against gt/scene.json; every listed colour image has its truth. Without
/// gt/frames.jsonl the id images alone.
void CheckTruthFrames(Folder& folder, const SequenceTruth& truth);

}  // namespace eval
