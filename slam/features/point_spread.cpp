#include "slam/features/point_spread.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace slam {
namespace {

/// A rectangle of the area, and which candidates lie in it.
struct Cell {
  double x0, y0, x1, y1;
  std::size_t begin, end;  ///< range of its candidates' indices, which ascend
  int number;              ///< count of cells made before: breaks ties

  std::size_t size() const { return end - begin; }
};

struct FullerFirst {
  bool operator()(const Cell& a, const Cell& b) const {
    if (a.size() != b.size()) return a.size() < b.size();
    return a.number > b.number;
  }
};

using CellQueue = std::priority_queue<Cell, std::vector<Cell>, FullerFirst>;

/// Candidates sorted by the cells of a quadtree that they lie in.
class Spread {
 public:
  Spread(const std::vector<cv::KeyPoint>& candidates, const cv::Rect& area)
      : candidates_(candidates), order_(candidates.size()), scratch_(candidates.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    // Square cells side by side; a wide image starts with more than one.
    const int columns = std::max(1, cvRound(static_cast<double>(area.width) / area.height));
    const double width = static_cast<double>(area.width) / columns;
    std::size_t begin = 0;
    for (int c = 0; c < columns; ++c) {
      const auto outside = [&](int i) {
        const double x = static_cast<double>(At(i).pt.x) - area.x;
        return std::clamp(static_cast<int>(x / width), 0, columns - 1) != c;
      };
      const std::size_t end = Part(begin, order_.size(), outside);
      const double x0 = area.x + c * width;
      Push({x0, static_cast<double>(area.y), x0 + width,
            static_cast<double>(area.y + area.height), begin, end, c});
      begin = end;
    }
    number_ = static_cast<int>(queue_.size());
  }

  /// Quarters the fullest cell.
  /// @returns whether it could be quartered
  bool Quarter() {
    constexpr double kMinCell_px = 1.0;  // smaller cells cannot part two corners
    const Cell cell = queue_.top();
    if (!(cell.size() > 1 && cell.x1 - cell.x0 > kMinCell_px)) return false;
    queue_.pop();
    // Sort the candidates into upper and lower half, and each half into left and right.
    const double x = 0.5 * (cell.x0 + cell.x1), y = 0.5 * (cell.y0 + cell.y1);
    const auto right = [&](int i) { return At(i).pt.x >= x; };
    const std::size_t lower =
        Part(cell.begin, cell.end, [&](int i) { return At(i).pt.y >= y; });
    const std::size_t above = Part(cell.begin, lower, right);
    const std::size_t below = Part(lower, cell.end, right);
    Push({cell.x0, cell.y0, x, y, cell.begin, above, number_});
    Push({x, cell.y0, cell.x1, y, above, lower, number_ + 1});
    Push({cell.x0, y, x, cell.y1, lower, below, number_ + 2});
    Push({x, y, cell.x1, cell.y1, below, cell.end, number_ + 3});
    number_ += 4;
    return true;
  }

  std::size_t size() const { return queue_.size(); }

  /// Indices of the strongest candidate of each cell, ascending. Empties the cells.
  std::vector<int> Strongest() {
    std::vector<int> kept;
    for (; !queue_.empty(); queue_.pop()) {
      int best = order_[queue_.top().begin];
      for (std::size_t k = queue_.top().begin; k < queue_.top().end; ++k)
        if (At(order_[k]).response > At(best).response) best = order_[k];
      kept.push_back(best);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
  }

 private:
  const cv::KeyPoint& At(int i) const { return candidates_[static_cast<std::size_t>(i)]; }

  void Push(const Cell& cell) {
    if (cell.size() > 0) queue_.push(cell);
  }

  /// Moves what is `last` behind the rest; the order of both stays.
  /// @returns where it begins
  template <typename Last>
  std::size_t Part(std::size_t begin, std::size_t end, const Last& last) {
    std::size_t kept = begin, moved = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const int i = order_[k];
      const bool is_last = last(i);
      order_[kept] = i, scratch_[moved] = i;  // one of them counts
      kept += is_last ? 0 : 1, moved += is_last ? 1 : 0;
    }
    std::copy_n(scratch_.begin(), moved, order_.begin() + static_cast<std::ptrdiff_t>(kept));
    return kept;
  }

  const std::vector<cv::KeyPoint>& candidates_;
  std::vector<int> order_, scratch_;
  CellQueue queue_;
  int number_ = 0;
};

}  // namespace

std::vector<cv::KeyPoint> SpreadEvenly(const std::vector<cv::KeyPoint>& candidates,
                                       const cv::Rect& area, int count) {
  if (count <= 0 || area.width <= 0 || area.height <= 0) return {};
  if (candidates.size() <= static_cast<std::size_t>(count)) return candidates;

  Spread spread(candidates, area);
  while (spread.size() < static_cast<std::size_t>(count) && spread.Quarter()) {
  }
  const std::vector<int> kept = spread.Strongest();
  std::vector<cv::KeyPoint> chosen;
  chosen.reserve(kept.size());
  for (const int i : kept) chosen.push_back(candidates[static_cast<std::size_t>(i)]);
  return chosen;
}

}  // namespace slam
