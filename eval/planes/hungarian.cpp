#include "eval/planes/hungarian.h"

#include <limits>

namespace eval {
namespace {

/// Shortest augmenting paths with potentials; rows <= columns, least cost.
std::vector<int> AssignMinCost(const Eigen::MatrixXd& cost) {
  const int rows = static_cast<int>(cost.rows()), cols = static_cast<int>(cost.cols());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  using Index = std::size_t;
  std::vector<double> u(Index(rows) + 1, 0.0), v(Index(cols) + 1, 0.0);
  std::vector<int> row_of(cols + 1, 0), way(cols + 1, 0);  // 1-based; 0 means free
  for (int row = 1; row <= rows; ++row) {
    row_of[0] = row;
    int col = 0;
    std::vector<double> least(cols + 1, kInfinity);
    std::vector<bool> used(cols + 1, false);
    do {
      used[col] = true;
      const int from = row_of[col];
      double delta = kInfinity;
      int next = 0;
      for (int j = 1; j <= cols; ++j) {
        if (used[j]) continue;
        const double reduced = cost(from - 1, j - 1) - u[from] - v[j];
        if (reduced < least[j]) {
          least[j] = reduced;
          way[j] = col;
        }
        if (least[j] < delta) {
          delta = least[j];
          next = j;
        }
      }
      for (int j = 0; j <= cols; ++j) {
        if (used[j]) {
          u[row_of[j]] += delta;
          v[j] -= delta;
        } else {
          least[j] -= delta;
        }
      }
      col = next;
    } while (row_of[col] != 0);
    do {
      const int previous = way[col];
      row_of[col] = row_of[previous];
      col = previous;
    } while (col != 0);
  }
  std::vector<int> col_of(rows, -1);
  for (int j = 1; j <= cols; ++j) {
    if (row_of[j] > 0) col_of[row_of[j] - 1] = j - 1;
  }
  return col_of;
}

}  // namespace

std::vector<int> AssignMaxWeight(const Eigen::MatrixXd& weight) {
  if (weight.rows() == 0 || weight.cols() == 0) {
    return std::vector<int>(static_cast<std::size_t>(weight.rows()), -1);
  }
  if (weight.rows() <= weight.cols()) return AssignMinCost(-weight);
  std::vector<int> col_of(static_cast<std::size_t>(weight.rows()), -1);
  const std::vector<int> row_of = AssignMinCost(-weight.transpose());
  for (std::size_t col = 0; col < row_of.size(); ++col) {
    if (row_of[col] >= 0) col_of[static_cast<std::size_t>(row_of[col])] = static_cast<int>(col);
  }
  return col_of;
}

}  // namespace eval
