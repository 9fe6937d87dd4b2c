#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace slam {

/// Neighbouring pixels of a row with one label, or with none.
struct LabelRun {
  int begin = 0, end = 0;  ///< columns, end excluded
  int label = 0;           ///< or kNoLabel
};

/// A label image as the runs of its rows; every row is covered from end to end.
struct LabelRuns {
  int width = 0;
  std::vector<LabelRun> runs;
  std::vector<std::size_t> rows;  ///< first run of each row, and one more
};

/// @param labels  width x height, row by row
void FindRuns(const std::vector<std::int16_t>& labels, int width, int height, LabelRuns& out);

/// Calls visit(a, b, begin, end, row) for every pair of runs, b below a in the next row, that
/// share the columns [begin, end).
template <typename Visit>
void VisitRunsBelow(const LabelRuns& runs, const Visit& visit) {
  for (std::size_t row = 0; row + 2 < runs.rows.size(); ++row) {
    std::size_t a = runs.rows[row], b = runs.rows[row + 1];
    const std::size_t a_end = b, b_end = runs.rows[row + 2];
    while (a < a_end && b < b_end) {
      const int begin = std::max(runs.runs[a].begin, runs.runs[b].begin);
      const int end = std::min(runs.runs[a].end, runs.runs[b].end);
      visit(a, b, begin, end, static_cast<int>(row));
      if (runs.runs[a].end == end) ++a;
      if (runs.runs[b].end == end) ++b;
    }
  }
}

/// Calls visit(i, j) for every two pixels, side by side or one above the other, that differ in
/// label; i < j.
template <typename Visit>
void VisitBoundaries(const LabelRuns& runs, const Visit& visit) {
  const auto width = static_cast<std::size_t>(runs.width);
  for (std::size_t row = 0; row + 1 < runs.rows.size(); ++row) {
    for (std::size_t a = runs.rows[row]; a + 1 < runs.rows[row + 1]; ++a) {
      const std::size_t i = row * width + static_cast<std::size_t>(runs.runs[a].end);
      visit(i - 1, i);
    }
  }
  VisitRunsBelow(runs, [&](std::size_t a, std::size_t b, int begin, int end, int row) {
    if (runs.runs[a].label == runs.runs[b].label) return;
    const std::size_t start = static_cast<std::size_t>(row) * width;
    for (auto u = static_cast<std::size_t>(begin); u < static_cast<std::size_t>(end); ++u)
      visit(start + u, start + u + width);
  });
}

}  // namespace slam
