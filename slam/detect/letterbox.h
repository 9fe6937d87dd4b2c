#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "slam/geometry/box.h"

namespace slam {

/// How an image of another shape is put into a network's input: scaled by one ratio, at the
/// top left; the rest is grey.
///
/// Source: YOLOX (Ge et al. 2021), its published `preproc` and export. One thing differs: back
/// in the image, coordinates are divided by the scale that rounding to whole pixels left on
/// each axis, and not by the ratio before rounding, so that the way there and back is exact.
class Letterbox {
 public:
  static constexpr int kPadding = 114;  ///< grey level of the rest: YOLOX

  /// @throws std::invalid_argument if a side is not positive.
  Letterbox(cv::Size image, cv::Size input);

  cv::Size input() const { return input_; }

  /// The network's input. @throws std::invalid_argument if the image has another size.
  cv::Mat3b Apply(const cv::Mat3b& bgr) const;

  /// From the input, whose first pixel spans [0, 1), to pixels of the image, centres at
  /// integers.
  Eigen::Vector2d ToImage(const Eigen::Vector2d& at_input) const;

 private:
  cv::Size image_, input_;
  cv::Size scaled_;  ///< the part of the input that shows the image
  Eigen::Array2d scale_;
};

}  // namespace slam
