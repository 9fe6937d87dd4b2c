#pragma once

#include "eval/formats/run.h"

namespace eval {

/// Checks the decisions of frame_planes.jsonl against map.json, when it could be read, and
/// against each other: map planes exist, and are "new" before they are "matched".
void CheckDecisions(Folder& folder, const Run& run);

}  // namespace eval
