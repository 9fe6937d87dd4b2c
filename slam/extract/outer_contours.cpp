#include "slam/extract/outer_contours.h"

#include <algorithm>
#include <cstring>

namespace slam {
namespace {

constexpr int kAtOnce = 8;      // cells; beyond a row there are others, for a while
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
  for (int v = 0; v < labels.rows; ++v) {
    const int row = CellAt({0, v});
    for (int u = 0; u < labels.cols; ++u) {
      const std::uint8_t* cell = cells_.data() + row + u;
      if (std::memcmp(cell, cell - 1, kAtOnce) == 0) {  // no segment begins here
        u += kAtOnce - 1;
        continue;
      }
      if (cell[0] == cell[-1] || cell[0] == 0) continue;
      const Mark* mark = marks_.data() + row + u;
      if (*mark == kUnmarked && !StartsInside(cell, mark, u)) Follow(row + u, {u, v});
    }
  }
  std::sort(contours_.begin(), contours_.end(), [](const Contour& a, const Contour& b) {
    if (a.label != b.label) return a.label < b.label;
    const std::size_t size_a = a.end - a.begin, size_b = b.end - b.begin;
    return size_a != size_b ? size_a > size_b : a.begin > b.begin;
  });
}

/// Whether pixel u of a row lies in a hole of its own segment: the segment's
/// last contour to the left has not ended.
bool OuterContours::StartsInside(const std::uint8_t* cell, const Mark* mark, int u) const {
  for (int k = 1; k <= u; ++k) {
    if (cell[-k] == cell[0] && mark[-k] != kUnmarked) return mark[-k] == kEdge;
  }
  return false;
}

void OuterContours::Follow(int start, const cv::Point& at) {
  const std::uint8_t label = cells_[static_cast<std::size_t>(start)];
  int step[2 * kDirections];
  for (int k = 0; k < 2 * kDirections; ++k)
    step[k] = kStepU[k % kDirections] + kStepV[k % kDirections] * stride_;
  const auto is_own = [&](int cell) { return cells_[static_cast<std::size_t>(cell)] == label; };
  const std::size_t begin = points_.size();
  // The last pixel of the walk: the first of the segment clockwise from the
  // left.
  int to = kLeft;
  do {
    to = (to + kDirections - 1) % kDirections;
  } while (to != kLeft && !is_own(start + step[to]));
  if (to == kLeft) {  // alone
    points_.push_back(at);
    marks_[static_cast<std::size_t>(start)] = kRightEdge;
  } else {
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
  cv::Point sum(0, 0);
  for (int dv = -2; dv <= 2; ++dv) {
    for (int du = -2; du <= 2; ++du) {
      const int outside = center[dv * stride_ + du] != *center ? 1 : 0;
      sum.x += outside * du, sum.y += outside * dv;
    }
  }
  return sum;
}

}  // namespace slam
