#include "slam/segment/pixel_area.h"

#include <algorithm>
#include <cmath>

namespace slam {
namespace {

/// Twice the signed area.
double Turning(const std::vector<Eigen::Vector2d>& outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Eigen::Vector2d& p = outline[i];
    const Eigen::Vector2d& q = outline[(i + 1) % outline.size()];
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return sum;
}

}  // namespace

cv::Rect PixelArea::Bounds() const {
  cv::Rect bounds;
  for (std::size_t row = 0; row < spans.size(); ++row) {
    const auto [first, end] = spans[row];
    if (first < end) bounds |= cv::Rect(first, top + static_cast<int>(row), end - first, 1);
  }
  return bounds;
}

void SetRectangle(const cv::Rect& rectangle, PixelArea& area) {
  area.top = rectangle.y;
  area.spans.assign(static_cast<std::size_t>(std::max(rectangle.height, 0)),
                    {rectangle.x, rectangle.x + rectangle.width});
}

void SetConvex(const std::vector<Eigen::Vector2d>& outline_px, double margin_px,
               const cv::Size& image, PixelArea& area) {
  area.spans.clear();
  const double turning = Turning(outline_px);
  if (outline_px.size() < 3 || turning == 0.0) return;
  double low = outline_px.front().y(), high = low;
  for (const Eigen::Vector2d& p : outline_px)
    low = std::min(low, p.y()), high = std::max(high, p.y());
  const double last_row = image.height - 1;
  area.top = static_cast<int>(std::clamp(std::ceil(low - margin_px), 0.0, last_row + 1.0));
  const int bottom = static_cast<int>(std::clamp(std::floor(high + margin_px), -1.0, last_row));
  for (int v = area.top; v <= bottom; ++v) {
    // n . u <= c for every side, n its outward normal.
    double first = 0.0, last = image.width - 1;
    for (std::size_t i = 0; i < outline_px.size(); ++i) {
      const Eigen::Vector2d& p = outline_px[i];
      const Eigen::Vector2d along = outline_px[(i + 1) % outline_px.size()] - p;
      const double length = along.norm();
      if (length == 0.0) continue;
      const Eigen::Vector2d n =
          Eigen::Vector2d(along.y(), -along.x()) * (turning > 0.0 ? 1.0 : -1.0) / length;
      const double rest = n.dot(p) + margin_px - n.y() * v;
      if (n.x() > 0.0) {
        last = std::min(last, rest / n.x());
      } else if (n.x() < 0.0) {
        first = std::max(first, rest / n.x());
      } else if (rest < 0.0) {
        last = first - 1.0;
      }
    }
    const double from = std::ceil(first), to = std::floor(last);
    if (from <= to) {
      area.spans.emplace_back(static_cast<int>(from), static_cast<int>(to) + 1);
    } else {
      area.spans.emplace_back(0, 0);
    }
  }
}

}  // namespace slam
