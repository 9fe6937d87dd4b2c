#include "slam/segment/edges/outer_contours.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "slam/segment/pixels/label_changes.h"

namespace slam {
namespace {

constexpr int kRowRead = 8;     // cells of a row that are read at once
constexpr int kDirections = 8;  // to the right, then counterclockwise
constexpr int kRight = 0, kLeft = 4;
constexpr int kStepU[kDirections] = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr int kStepV[kDirections] = {0, -1, -1, -1, 0, 1, 1, 1};
constexpr std::uint64_t kEveryByte = 0x0101010101010101;

}  // namespace

void OuterContours::Trace(const cv::Mat1b& labels) {
  stride_ = labels.cols + 2 * kFrame;
  const auto cells = static_cast<std::size_t>(stride_ * (labels.rows + 2 * kFrame));
  cells_.assign(cells + kRowRead, 0), marks_.assign(cells, kUnmarked);
  points_.clear(), contours_.clear();
  for (int v = 0; v < labels.rows; ++v)
    std::copy_n(labels[v], labels.cols, cells_.data() + CellAt({0, v}));

  // Row by row; where a label begins that no walk has passed yet, a contour may begin.
  last_in_row_.assign(1 + std::numeric_limits<std::uint8_t>::max(), -1);
  for (int v = 0; v < labels.rows; ++v) {
    const int row = CellAt({0, v});
    VisitChanges(cells_.data(), row, row + labels.cols + 1, [&](int at) {
      const std::uint8_t before = cells_[static_cast<std::size_t>(at - 1)];
      const std::uint8_t label = cells_[static_cast<std::size_t>(at)];
      last_in_row_[before] = at - 1;
      if (label == 0 || marks_[static_cast<std::size_t>(at)] != kUnmarked) return;
      // It lies in a hole of its own segment if that has not ended with its last pixel.
      const int last = last_in_row_[label];
      if (last < row || marks_[static_cast<std::size_t>(last)] == kRightEdge)
        Follow(at, {at - row, v});
    });
  }
  std::sort(contours_.begin(), contours_.end(), [](const Contour& a, const Contour& b) {
    if (a.label != b.label) return a.label < b.label;
    const std::size_t size_a = a.end - a.begin, size_b = b.end - b.begin;
    return size_a != size_b ? size_a > size_b : a.begin > b.begin;
  });
}

void OuterContours::Follow(int start, const cv::Point& at) {
  const std::uint8_t label = cells_[static_cast<std::size_t>(start)];
  int step[2 * kDirections];
  for (int k = 0; k < 2 * kDirections; ++k)
    step[k] = kStepU[k % kDirections] + kStepV[k % kDirections] * stride_;
  const auto is_own = [&](int cell) { return cells_[static_cast<std::size_t>(cell)] == label; };
  const std::size_t begin = points_.size();

  // The last pixel of the walk: the first of the segment clockwise from the left.
  int to = kLeft;
  do {
    to = (to + kDirections - 1) % kDirections;
  } while (to != kLeft && !is_own(start + step[to]));
  if (to == kLeft) {  // alone
    points_.push_back(at);
    marks_[static_cast<std::size_t>(start)] = kRightEdge;
  } else {
    // From pixel to pixel, counterclockwise from the one before, until the walk closes.
    const int last = start + step[to];
    cv::Point here = at;
    for (int cell = start;;) {
      const int from = to;
      int next = cell;
      for (bool found = false; !found; found = is_own(next)) next = cell + step[++to];
      to %= kDirections;
      Mark& mark = marks_[static_cast<std::size_t>(cell)];
      if (to > kRight && to <= from) {  // has looked to the right
        mark = kRightEdge;
      } else if (mark == kUnmarked) {
        mark = kEdge;
      }
      points_.push_back(here);
      here += cv::Point(kStepU[to], kStepV[to]);
      if (next == start && cell == last) break;
      cell = next;
      to = (to + kLeft) % kDirections;
    }
  }
  contours_.push_back({label, begin, points_.size()});
}

cv::Point OuterContours::Outward(const cv::Point& at) const {
  const std::uint8_t* center = cells_.data() + CellAt(at);
  const std::uint64_t own = kEveryByte * *center;
  std::uint64_t outside[5];  // a byte for each of five pixels of a row: 1 or 0
  for (int k = 0; k < 5; ++k) {
    std::uint64_t row;
    std::memcpy(&row, center + (k - 2) * stride_ - 2, sizeof row);
    row ^= own;
    const std::uint64_t low = 0x7f * kEveryByte;
    outside[k] = (((row & low) + low) | row) >> 7 & kEveryByte;
  }
  std::uint8_t column[8], above[8], below[8];
  const auto store = [](std::uint64_t bytes, std::uint8_t* to) {
    std::memcpy(to, &bytes, sizeof bytes);
  };
  store(outside[0] + outside[1] + outside[2] + outside[3] + outside[4], column);
  store(2 * outside[0] + outside[1], above);
  store(outside[3] + 2 * outside[4], below);
  int down = 0;
  for (int k = 0; k < 5; ++k) down += below[k] - above[k];
  return {2 * (column[4] - column[0]) + column[3] - column[1], down};
}

}  // namespace slam
