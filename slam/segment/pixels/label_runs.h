#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "slam/segment/pixels/label_pairs.h"

namespace slam {

inline constexpr std::int16_t kNoLabel = -1;
using LabelImage = std::vector<std::int16_t>;  ///< one entry a pixel, kNoLabel or an index

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

  /// The run that a pixel is in.
  std::size_t At(int u, int v) const;
};

/// Writes over `out`, whose memory serves again.
/// @param labels  width x height, row by row
void FindRuns(const LabelImage& labels, int width, int height, LabelRuns& out);

/// Calls visit(a, b, begin, end) for every pair of runs, b below a in the next row, that share
/// the columns [begin, end).
template <typename Visit>
void VisitRunsBelow(const LabelRuns& runs, const Visit& visit) {
  for (std::size_t row = 0; row + 2 < runs.rows.size(); ++row) {
    std::size_t a = runs.rows[row], b = runs.rows[row + 1];
    const std::size_t a_end = b, b_end = runs.rows[row + 2];
    while (a < a_end && b < b_end) {
      const int begin = std::max(runs.runs[a].begin, runs.runs[b].begin);
      const int end = std::min(runs.runs[a].end, runs.runs[b].end);
      visit(a, b, begin, end);
      if (runs.runs[a].end == end) ++a;
      if (runs.runs[b].end == end) ++b;
    }
  }
}

/// How long the borders between labels are, in sides of pixels.
struct LabelContacts {
  LabelPairs<int> shared;   ///< of two labels
  std::vector<int> around;  ///< of each label with all that is beside it in the image
};

LabelContacts CountContacts(const LabelRuns& runs, std::size_t label_count);

}  // namespace slam
