#include "slam/extract/point_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>

namespace slam {
namespace {

struct Cell {
  double x0, y0, x1, y1;
  std::vector<int> members;  ///< indices of candidates, ascending
  int number;                ///< count of cells made before: breaks ties
};

struct FullerFirst {
  bool operator()(const Cell& a, const Cell& b) const {
    if (a.members.size() != b.members.size()) return a.members.size() < b.members.size();
    return a.number > b.number;
  }
};

using CellQueue = std::priority_queue<Cell, std::vector<Cell>, FullerFirst>;

/// Square cells side by side; a wide image starts with more than one.
CellQueue FirstCells(const std::vector<cv::KeyPoint>& candidates, const cv::Rect& area) {
  const int columns = std::max(1, cvRound(static_cast<double>(area.width) / area.height));
  const double width = static_cast<double>(area.width) / columns;
  std::vector<Cell> cells;
  for (int c = 0; c < columns; ++c) {
    const double x0 = area.x + c * width;
    cells.push_back({x0,
                     static_cast<double>(area.y),
                     x0 + width,
                     static_cast<double>(area.y + area.height),
                     {},
                     c});
  }
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    const double x = static_cast<double>(candidates[static_cast<std::size_t>(i)].pt.x) - area.x;
    const int c = std::clamp(static_cast<int>(x / width), 0, columns - 1);
    cells[static_cast<std::size_t>(c)].members.push_back(i);
  }
  CellQueue queue;
  for (Cell& cell : cells) {
    if (!cell.members.empty()) queue.push(std::move(cell));
  }
  return queue;
}

std::array<Cell, 4> Quarter(const Cell& cell, const std::vector<cv::KeyPoint>& candidates,
                            int number) {
  const double x = 0.5 * (cell.x0 + cell.x1), y = 0.5 * (cell.y0 + cell.y1);
  std::array<Cell, 4> quarters{Cell{cell.x0, cell.y0, x, y, {}, number},
                               Cell{x, cell.y0, cell.x1, y, {}, number + 1},
                               Cell{cell.x0, y, x, cell.y1, {}, number + 2},
                               Cell{x, y, cell.x1, cell.y1, {}, number + 3}};
  for (const int i : cell.members) {
    const cv::Point2f& p = candidates[static_cast<std::size_t>(i)].pt;
    quarters[(p.x >= x ? 1u : 0u) + (p.y >= y ? 2u : 0u)].members.push_back(i);
  }
  return quarters;
}

int Strongest(const std::vector<int>& members, const std::vector<cv::KeyPoint>& candidates) {
  int best = members.front();
  for (const int i : members) {
    if (candidates[static_cast<std::size_t>(i)].response >
        candidates[static_cast<std::size_t>(best)].response) {
      best = i;
    }
  }
  return best;
}

}  // namespace

std::vector<cv::KeyPoint> SpreadEvenly(const std::vector<cv::KeyPoint>& candidates,
                                       const cv::Rect& area, int count) {
  if (count <= 0 || area.width <= 0 || area.height <= 0) return {};
  if (candidates.size() <= static_cast<std::size_t>(count)) return candidates;

  CellQueue queue = FirstCells(candidates, area);
  int number = static_cast<int>(queue.size());
  while (queue.size() < static_cast<std::size_t>(count)) {
    const Cell fullest = queue.top();
    const bool splits = fullest.members.size() > 1 && fullest.x1 - fullest.x0 > 1.0;
    if (!splits) break;  // all others hold no more than this one
    queue.pop();
    for (Cell& quarter : Quarter(fullest, candidates, number)) {
      if (!quarter.members.empty()) queue.push(std::move(quarter));
    }
    number += 4;
  }
  std::vector<int> kept;
  for (; !queue.empty(); queue.pop())
    kept.push_back(Strongest(queue.top().members, candidates));
  std::sort(kept.begin(), kept.end());

  std::vector<cv::KeyPoint> chosen;
  chosen.reserve(kept.size());
  for (const int i : kept) chosen.push_back(candidates[static_cast<std::size_t>(i)]);
  return chosen;
}

}  // namespace slam
