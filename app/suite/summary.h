#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/suite/results.h"

namespace app {

/// What a suite found, as plain lines: a line an arm with the figures that matter most, each case
/// that is not done with the line that runs it again, and the shares of the time spent.
/// @param cases  those of the suite; others in the results are passed over
std::string SuiteSummary(const std::vector<SuiteCase>& cases,
                         const std::map<std::string, ResultRow>& rows);

}  // namespace app
