#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "slam/base/index.h"

namespace slam {

/// The outer contours of the segments of a label image, each in the order in which one walks
/// along it from its first pixel, 8-connected; what lies in a hole of its own segment has none.
///
/// Source: Suzuki and Abe, CVGIP 30 (1985), point by point as cv::findContours (RETR_EXTERNAL,
/// CHAIN_APPROX_NONE) follows each segment alone. Our own because it follows all of them at
/// once: with cv::findContours in the bounds of each segment the whole extraction took 5 % more
/// instructions and 4 to 8 % more time (callgrind; desks of kinect1 and d435).
class OuterContours {
 public:
  struct Contour {
    int label = 0;
    std::size_t begin = 0, end = 0;  ///< in points()
  };

  /// @param labels  0 = none
  void Trace(const cv::Mat1b& labels);

  /// By label, the longest first.
  const std::vector<Contour>& contours() const { return contours_; }
  const std::vector<cv::Point>& points() const { return points_; }

  /// The label image's value at a pixel of it.
  int LabelAt(const cv::Point& at) const { return cells_[Index(CellAt(at))]; }

  /// Direction from a pixel to the outside of its segment: the sum of its outside neighbours,
  /// two to each side.
  cv::Point Outward(const cv::Point& at) const;

 private:
  /// What is known of a pixel on a contour. To the right of a right edge is the outside.
  enum Mark : std::uint8_t { kUnmarked, kEdge, kRightEdge };

  int CellAt(const cv::Point& at) const { return (at.y + kFrame) * stride_ + at.x + kFrame; }
  void Follow(int start, const cv::Point& at);

  static constexpr int kFrame = 2;  ///< pixels without label around the image

  int stride_ = 0;
  std::vector<std::uint8_t> cells_;  ///< the labels, framed
  std::vector<Mark> marks_;          ///< framed too
  std::vector<int> last_in_row_;     ///< each label's last cell before those looked at
  std::vector<cv::Point> points_;
  std::vector<Contour> contours_;
};

}  // namespace slam
