#include "slam/segment/edges/outer_contours.h"

#include <algorithm>
#include <limits>

#include "slam/base/index.h"
#include "slam/segment/pixels/label_changes.h"

namespace slam {
namespace {

constexpr int kDirections = 8;  // to the right, then counterclockwise
constexpr int kRight = 0, kLeft = 4;
constexpr int kStepU[kDirections] = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr int kStepV[kDirections] = {0, -1, -1, -1, 0, 1, 1, 1};

}  // namespace

void OuterContours::Trace(const cv::Mat1b& labels) {
  stride_ = labels.cols + 2 * kFrame;
  const auto cells = static_cast<std::size_t>(stride_ * (labels.rows + 2 * kFrame));
  cells_.assign(cells, 0), marks_.assign(cells, kUnmarked);
  points_.clear(), contours_.clear();
  for (int v = 0; v < labels.rows; ++v)
    std::copy_n(labels[v], labels.cols, cells_.data() + CellAt({0, v}));

  // Row by row; where a label begins that no walk has passed yet, a contour may begin.
  last_in_row_.assign(1 + std::numeric_limits<std::uint8_t>::max(), -1);
  for (int v = 0; v < labels.rows; ++v) {
    const int row = CellAt({0, v});
    VisitChanges(cells_.data(), row, row + labels.cols + 1, [&](int at) {
      const std::uint8_t before = cells_[Index(at - 1)];
      const std::uint8_t label = cells_[Index(at)];
      last_in_row_[before] = at - 1;
      if (label == 0 || marks_[Index(at)] != kUnmarked) return;
      // It lies in a hole of its own segment if that has not ended with its last pixel.
      const int last = last_in_row_[label];
      if (last < row || marks_[Index(last)] == kRightEdge) Follow(at, {at - row, v});
    });
  }
  std::sort(contours_.begin(), contours_.end(), [](const Contour& a, const Contour& b) {
    if (a.label != b.label) return a.label < b.label;
    const std::size_t size_a = a.end - a.begin, size_b = b.end - b.begin;
    return size_a != size_b ? size_a > size_b : a.begin > b.begin;
  });
}

void OuterContours::Follow(int start, const cv::Point& at) {
  const std::uint8_t label = cells_[Index(start)];
  int step[2 * kDirections];
  for (int k = 0; k < 2 * kDirections; ++k)
    step[k] = kStepU[k % kDirections] + kStepV[k % kDirections] * stride_;
  const auto is_own = [&](int cell) { return cells_[Index(cell)] == label; };
  const std::size_t begin = points_.size();

  // The last pixel of the walk: the first of the segment clockwise from the left.
  int to = kLeft;
  do {
    to = (to + kDirections - 1) % kDirections;
  } while (to != kLeft && !is_own(start + step[to]));
  if (to == kLeft) {  // alone
    points_.push_back(at);
    marks_[Index(start)] = kRightEdge;
  } else {
    // From pixel to pixel, counterclockwise from the one before, until the walk closes.
    const int last = start + step[to];
    cv::Point here = at;
    for (int cell = start;;) {
      const int from = to;
      int next = cell;
      for (bool found = false; !found; found = is_own(next)) next = cell + step[++to];
      to %= kDirections;
      Mark& mark = marks_[Index(cell)];
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
  cv::Point sum;
  for (int v = -kFrame; v <= kFrame; ++v)
    for (int u = -kFrame; u <= kFrame; ++u)
      if (center[v * stride_ + u] != *center) sum += cv::Point(u, v);
  return sum;
}

}  // namespace slam
