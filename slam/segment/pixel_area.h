#pragma once

#include <Eigen/Core>
#include <opencv2/core/types.hpp>
#include <utility>
#include <vector>

namespace slam {

/// Pixels of an image: a span of columns in each row.
struct PixelArea {
  int top = 0;
  std::vector<std::pair<int, int>> spans;  ///< [first, end) of each row; first = end: none

  bool Contains(const cv::Point& at) const {
    const int row = at.y - top;
    if (row < 0 || row >= static_cast<int>(spans.size())) return false;
    const auto [first, end] = spans[static_cast<std::size_t>(row)];
    return at.x >= first && at.x < end;
  }
  cv::Rect Bounds() const;
};

/// Sets the pixels of a rectangle.
void SetRectangle(const cv::Rect& rectangle, PixelArea& area);

/// Sets the pixels of the image whose centres are within the sides of a convex outline, each
/// moved outwards by `margin_px` (inwards if negative).
/// @param outline_px  its corners in order, either way round, pixel coordinates; fewer than
///                    three: no pixel
void SetConvex(const std::vector<Eigen::Vector2d>& outline_px, double margin_px,
               const cv::Size& image, PixelArea& area);

}  // namespace slam
