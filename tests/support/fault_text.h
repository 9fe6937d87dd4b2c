#pragma once

#include <string>

#include "eval/check/report.h"

namespace eval {

/// Every fault, one a line.
inline std::string All(const CheckReport& report) {
  std::string text;
  for (const Fault& fault : report.faults) text += Describe(fault) + "\n";
  return text;
}

}  // namespace eval
