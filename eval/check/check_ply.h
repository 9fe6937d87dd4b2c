#pragma once

#include "eval/check/check_map.h"
#include "eval/check/fault.h"

namespace eval {

/// Checks map.ply: header, number of points, finite coordinates, plane ids of map.json.
void CheckPly(FolderCheck& check, const CheckedMap& map);

}  // namespace eval
