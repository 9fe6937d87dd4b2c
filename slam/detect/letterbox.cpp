#include "slam/detect/letterbox.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/imgproc.hpp>

#include "slam/base/require.h"

namespace slam {

Letterbox::Letterbox(cv::Size image, cv::Size input) : image_(image), input_(input) {
  Require(image.width > 0 && image.height > 0 && input.width > 0 && input.height > 0,
          "Letterbox: an image has at least one pixel");
  // In whole numbers, so that the side that fills the input does so to the last pixel.
  const std::int64_t wide = std::int64_t{input.width} * image.height;
  const std::int64_t tall = std::int64_t{input.height} * image.width;
  scaled_ = input;
  if (wide <= tall) {
    scaled_.height = std::max(1, static_cast<int>(wide / image.width));
  } else {
    scaled_.width = std::max(1, static_cast<int>(tall / image.height));
  }
  scale_ = {static_cast<double>(scaled_.width) / image.width,
            static_cast<double>(scaled_.height) / image.height};
}

cv::Mat3b Letterbox::Apply(const cv::Mat3b& bgr) const {
  Require(bgr.size() == image_, "Letterbox: the image has another size");
  cv::Mat3b padded(input_, cv::Vec3b::all(kPadding));
  cv::resize(bgr, padded(cv::Rect({0, 0}, scaled_)), scaled_, 0, 0, cv::INTER_LINEAR);
  return padded;
}

Eigen::Vector2d Letterbox::ToImage(const Eigen::Vector2d& at_input) const {
  return (at_input.array() / scale_ - 0.5).matrix();
}

}  // namespace slam
