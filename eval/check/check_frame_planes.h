#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "eval/check/check_map.h"
#include "eval/check/fault.h"

namespace eval {

/// What frame_planes.jsonl holds, for the files that must agree with it.
struct FramePlaneCounts {
  std::vector<double> stamps_s;         ///< ascending, one a line
  std::vector<std::set<long>> indices;  ///< plane indices of each of them
};

/// Checks frame_planes.jsonl: one line a frame, planes that face the camera (unit normal, d >
/// 0), legal words, map planes that exist and are "new" before they are "matched".
FramePlaneCounts CheckFramePlanes(FolderCheck& check, const CheckedMap& map);

}  // namespace eval
