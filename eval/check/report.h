#pragma once

#include <string>
#include <vector>

#include "eval/formats/folder.h"

namespace eval {

/// The outcome of a check.
struct CheckReport {
  std::string kind;  ///< "sequence" or "run"
  std::vector<Fault> faults;
  int files = 0;
  int frames = 0;
};

}  // namespace eval
