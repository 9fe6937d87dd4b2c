#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/suite/results.h"
#include "eval/regression/gate.h"

namespace app {

/// The name of this machine's processor, as /proc/cpuinfo gives it; "unknown" without one.
std::string ProcessorName();

/// Whether times of two processors of these names can be compared; "unknown" is like no other.
bool IsSameProcessor(const std::string& one, const std::string& other);

/// Number and size of the frames, which a baseline must share.
std::string PlanText(const SuiteFile& suite);

/// The cases that the suite wants gated, as the gate takes them.
eval::GateCases GatedCases(const SuiteFile& suite, const std::vector<SuiteCase>& cases,
                           const std::map<std::string, ResultRow>& rows);

/// How often the gate may ask while it doubles the number of seeds up to the suite's most.
int LooksOf(const SuiteSeeds& seeds);

}  // namespace app
