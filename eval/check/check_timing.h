#pragma once

#include "eval/check/fault.h"

namespace eval {

/// Checks timing.csv: a header with `timestamp` and the ten modules, and rows of milliseconds.
void CheckTiming(FolderCheck& check);

}  // namespace eval
