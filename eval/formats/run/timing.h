#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"

namespace eval {

/// timing.csv: milliseconds per module and frame; NaN where a cell is empty.
struct Timing {
  std::vector<std::string> modules;  ///< column names after `timestamp`
  std::vector<double> stamps_s;
  std::vector<std::vector<double>> rows_ms;  ///< one per stamp, one entry per module
};

/// Reads timing.csv. A header without one of the modules of the paper's table is a flaw.
Timing ReadTiming(Folder& folder, const std::string& file = "timing.csv");

}  // namespace eval
