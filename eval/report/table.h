#pragma once

#include <string>

#include "eval/report/evaluate.h"

namespace eval {

/// The figures that matter most, as a table of plain lines for a terminal; a figure that is not
/// defined says so. Ends in a newline.
std::string MetricsTable(const Evaluation& evaluation);

/// The same for label images alone.
std::string LabelsTable(const LabelEvaluation& evaluation);

}  // namespace eval
