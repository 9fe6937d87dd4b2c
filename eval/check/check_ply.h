#pragma once

#include "eval/formats/run/run.h"

namespace eval {

/// Checks map.ply: header, number of points, finite coordinates, plane ids of map.json when it
/// could be read.
void CheckPly(Folder& folder, const Run& run);

}  // namespace eval
