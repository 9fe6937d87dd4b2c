#include "io/image/as_bgr.h"

#include <opencv2/imgproc.hpp>

namespace io {

cv::Mat AsBgr(const cv::Mat& image) {
  cv::Mat bgr = image;
  switch (image.empty() ? CV_8UC3 : image.type()) {
    case CV_8UC1:
      cv::cvtColor(image, bgr, cv::COLOR_GRAY2BGR);
      break;
    case CV_8UC2: {
      cv::Mat gray;
      cv::extractChannel(image, gray, 0);
      cv::cvtColor(gray, bgr, cv::COLOR_GRAY2BGR);
      break;
    }
    case CV_8UC4:
      cv::cvtColor(image, bgr, cv::COLOR_BGRA2BGR);
      break;
    default:
      break;
  }
  return bgr;
}

}  // namespace io
