#include "eval/plot/plotted_run.h"

#include "eval/plot/axes.h"

namespace eval {

std::vector<LegendEntry> LegendOf(const std::vector<PlottedRun>& runs) {
  std::vector<LegendEntry> entries;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    entries.push_back({runs[i].name, StyleOfSeries(i)});
  }
  return entries;
}

}  // namespace eval
