#pragma once

#include <nlohmann/json.hpp>

#include "eval/report/evaluate.h"

namespace eval {

/// The document metrics.json, format "pas-metrics/1". Keys are a contract and stand in a fixed
/// order. A figure that is not defined is null, and `reasons` says why under "group/figure"; a group
/// whose files are not there is absent. `warnings` says what to know of run (RUN) and sequence
/// (SEQ), `rules` in words how each group was counted.
nlohmann::ordered_json MetricsJson(const Evaluation& evaluation);

/// Its bytes: indented, numbers with the digits that give them back, a newline at the end.
std::string MetricsText(const Evaluation& evaluation);

/// The same document for label images alone: the group `extraction`.
nlohmann::ordered_json LabelsJson(const LabelEvaluation& evaluation);

}  // namespace eval
