#include "slam/detect/box_assignment.h"

#include <algorithm>
#include <limits>

#include "slam/base/require.h"

namespace slam {

std::vector<int> AssignForLargestGain(const std::vector<std::vector<double>>& gain) {
  const std::size_t rows = gain.size();
  const std::size_t columns = rows == 0 ? 0 : gain[0].size();
  for (const auto& row : gain)
    Require(row.size() == columns, "AssignForLargestGain: rows of different lengths");
  if (columns == 0) return std::vector<int>(rows, -1);

  // Square and of cost >= 0 when padded: being unassigned is a pair of gain 0.
  const std::size_t n = std::max(rows, columns);
  const auto cost = [&](std::size_t r, std::size_t c) {
    return r < rows && c < columns ? -std::max(gain[r][c], 0.0) : 0.0;
  };

  // Rows are added one by one. Position 0 of `row_of` and `way` is a virtual column from which
  // each augmenting path starts.
  constexpr double kInf = std::numeric_limits<double>::infinity();
  std::vector<double> row_price(n + 1, 0.0), column_price(n + 1, 0.0);
  std::vector<std::size_t> row_of(n + 1, 0), way(n + 1, 0);
  for (std::size_t r = 1; r <= n; ++r) {
    std::vector<double> slack(n + 1, kInf);
    std::vector<bool> reached(n + 1, false);
    row_of[0] = r;
    std::size_t at = 0;
    // Shortest path by reduced costs to a column that is free.
    do {
      reached[at] = true;
      const std::size_t from = row_of[at];
      double step = kInf;
      std::size_t next = 0;
      for (std::size_t c = 1; c <= n; ++c) {
        if (reached[c]) continue;
        const double reduced = cost(from - 1, c - 1) - row_price[from] - column_price[c];
        if (reduced < slack[c]) slack[c] = reduced, way[c] = at;
        if (slack[c] < step) step = slack[c], next = c;
      }
      // Prices, so that the path found so far costs nothing.
      for (std::size_t c = 0; c <= n; ++c) {
        if (reached[c])
          row_price[row_of[c]] += step, column_price[c] -= step;
        else
          slack[c] -= step;
      }
      at = next;
    } while (row_of[at] != 0);
    // Along the path each row moves on to the next column.
    for (; at != 0; at = way[at]) row_of[at] = row_of[way[at]];
  }

  std::vector<int> column_of(rows, -1);
  for (std::size_t c = 1; c <= columns; ++c) {
    const std::size_t r = row_of[c];
    if (r <= rows && gain[r - 1][c - 1] > 0) column_of[r - 1] = static_cast<int>(c - 1);
  }
  return column_of;
}

}  // namespace slam
