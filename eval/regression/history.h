#pragma once

#include <optional>
#include <vector>

#include "eval/regression/gate.h"

namespace eval {

/// Whether a figure has crept: it is worse than the median of all baselines that were ever
/// accepted, by more than what matters, and by more than steps as large as theirs (median absolute
/// deviation) add up to by chance, though no step was worse by itself. Nothing with fewer than three
/// baselines.
/// @param shift  of the candidate against the last baseline, a harm
/// Source: metrics.md 5.3, "median + k MAD per metric for slow drift that pairwise gates miss"; the
/// MAD of the steps, as that of the levels grows with a steady drift and hides it.
std::optional<Drift> DriftOf(const std::vector<PastBaseline>& history, const std::string& arm,
                             const GatedMetric& metric, double shift);

/// The history of the baseline that is accepted in place of `before`, with what the gate says of
/// the two: one step more. A figure that is WORSE or has drifted begins anew, as whoever accepts it
/// was told.
std::vector<PastBaseline> HistoryAfter(const Baseline& before, const GateReport& report);

}  // namespace eval
