#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

namespace eval {

/// Gives labels places that do not overlap, near where they belong.
class LabelLayout {
 public:
  explicit LabelLayout(cv::Rect2d page) : page_(page) {}

  /// A free place for a label centred near `at`, at most `reach` label heights away.
  std::optional<cv::Rect2d> Place(cv::Point2d at, cv::Size2d size, int reach = 4) {
    // To eighths of a pixel, so that round-off does not tip a label over to the next pixel.
    at = {std::round(at.x * 8) / 8, std::round(at.y * 8) / 8};
    for (int ring = 0; ring <= reach; ++ring) {
      for (int k = 0; k < (ring == 0 ? 1 : 8); ++k) {
        constexpr double kDirections[8][2] = {{0, 1}, {0, -1}, {1, 0},  {-1, 0},
                                              {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
        const double dx = ring == 0 ? 0 : kDirections[k][0] * ring * size.width * 0.35;
        const double dy = ring == 0 ? 0 : kDirections[k][1] * ring * size.height;
        const cv::Rect2d place(at.x - size.width / 2 + dx, at.y - size.height / 2 + dy,
                               size.width, size.height);
        const cv::Rect2d inside = Inside(place);
        if (!IsFree(inside)) continue;
        taken_.push_back(inside);
        return inside;
      }
    }
    return std::nullopt;
  }

 private:
  cv::Rect2d Inside(cv::Rect2d r) const {
    r.x = std::clamp(r.x, page_.x, std::max(page_.x, page_.x + page_.width - r.width));
    r.y = std::clamp(r.y, page_.y, std::max(page_.y, page_.y + page_.height - r.height));
    return r;
  }
  bool IsFree(const cv::Rect2d& r) const {
    constexpr double kApart_px = 2;  // labels that touch read as one
    const cv::Rect2d wide(r.x - kApart_px, r.y - kApart_px, r.width + 2 * kApart_px,
                          r.height + 2 * kApart_px);
    return std::none_of(taken_.begin(), taken_.end(),
                        [&](const cv::Rect2d& other) { return (wide & other).area() > 0; });
  }

  cv::Rect2d page_;
  std::vector<cv::Rect2d> taken_;
};

}  // namespace eval
