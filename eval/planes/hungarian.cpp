#include "eval/planes/hungarian.h"

#include <limits>

namespace eval {
namespace {

/// Shortest augmenting paths with potentials; rows <= columns, least cost. Rows and columns
/// count from 1, so that 0 can mean "free".
class LeastCost {
 public:
  explicit LeastCost(const Eigen::MatrixXd& cost)
      : cost_(cost),
        rows_(static_cast<std::size_t>(cost.rows())),
        cols_(static_cast<std::size_t>(cost.cols())),
        u_(rows_ + 1, 0.0),
        v_(cols_ + 1, 0.0),
        row_of_(cols_ + 1, 0),
        way_(cols_ + 1, 0) {}

  std::vector<int> Solve() {
    for (std::size_t row = 1; row <= rows_; ++row) Augment(row);
    std::vector<int> col_of(rows_, -1);
    for (std::size_t j = 1; j <= cols_; ++j) {
      if (row_of_[j] > 0) col_of[row_of_[j] - 1] = static_cast<int>(j) - 1;
    }
    return col_of;
  }

 private:
  double Reduced(std::size_t row, std::size_t col) const {
    return cost_(static_cast<Eigen::Index>(row) - 1, static_cast<Eigen::Index>(col) - 1) -
           u_[row] - v_[col];
  }

  /// Finds a column for `row`, moving earlier rows along the cheapest path.
  void Augment(std::size_t row) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<double> least(cols_ + 1, kInfinity);
    std::vector<bool> used(cols_ + 1, false);
    row_of_[0] = row;
    std::size_t col = 0;
    do {
      used[col] = true;
      double delta = kInfinity;
      std::size_t next = 0;
      for (std::size_t j = 1; j <= cols_; ++j) {
        if (used[j]) continue;
        const double reduced = Reduced(row_of_[col], j);
        if (reduced < least[j]) {
          least[j] = reduced;
          way_[j] = col;
        }
        if (least[j] < delta) {
          delta = least[j];
          next = j;
        }
      }
      for (std::size_t j = 0; j <= cols_; ++j) {
        if (used[j]) {
          u_[row_of_[j]] += delta;
          v_[j] -= delta;
        } else {
          least[j] -= delta;
        }
      }
      col = next;
    } while (row_of_[col] != 0);
    while (col != 0) {
      row_of_[col] = row_of_[way_[col]];
      col = way_[col];
    }
  }

  const Eigen::MatrixXd& cost_;
  std::size_t rows_, cols_;
  std::vector<double> u_, v_;
  std::vector<std::size_t> row_of_, way_;
};

std::vector<int> AssignMinCost(const Eigen::MatrixXd& cost) { return LeastCost(cost).Solve(); }

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
