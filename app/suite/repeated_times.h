#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/suite/results.h"
#include "app/suite/run_suite.h"

namespace app {

/// Runs cases again for their times alone: a machine that has other work is slower for a minute
/// and faster for the next, and one run of a suite is over in that. Each time, the results go
/// to a folder below FOLDER/times, where a later call finds them.
/// @param rows  of the cases and of others; of these cases each ratio of times becomes the median
///   over all runs
/// @returns the rows, or nothing when it was stopped before the end
/// @throws InputError
std::optional<std::map<std::string, ResultRow>> MeasureTimesAgain(
    const std::vector<SuiteCase>& cases, const SuiteRunOptions& options,
    std::map<std::string, ResultRow> rows);

}  // namespace app
