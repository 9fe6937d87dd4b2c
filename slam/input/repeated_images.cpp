#include "slam/input/repeated_images.h"

#include <cstring>

namespace slam {
namespace {

bool SameBits(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  const std::size_t row_bytes = static_cast<std::size_t>(a.cols) * a.elemSize();
  for (int v = 0; v < a.rows; ++v) {
    if (std::memcmp(a.ptr(v), b.ptr(v), row_bytes) != 0) return false;
  }
  return true;
}

}  // namespace

bool RepeatedImages::Repeats(const RecordedFrame& frame) {
  if (!bgr_.empty() && in_a_row_ < kMaxRepeats && SameBits(bgr_, frame.bgr) &&
      SameBits(depth_m_, frame.depth_m)) {
    ++in_a_row_, ++count_;
    return true;
  }
  in_a_row_ = 0;
  bgr_ = frame.bgr;
  depth_m_ = frame.depth_m;
  return false;
}

}  // namespace slam
