#include "slam/run/repeated_frame.h"

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

bool RepeatsImages(const TrackedFrame& last, const RecordedFrame& next) {
  return SameBits(last.bgr, next.bgr) && SameBits(last.frame.depth_m, next.depth_m);
}

void RepeatAt(const RecordedFrame& next, TrackedFrame& last) {
  last.frame.index = next.index;
  last.frame.timestamp_s = next.timestamp_s;
  for (PlaneMatch& match : last.frame.plane_matches) {
    if (match.decision == PlaneDecision::kNew) match.decision = PlaneDecision::kMatched;
  }
  last.report.times = {};
  last.report.keyframe = false;
  last.report.points.by_relocalising = false;  // that was the frame before
}

}  // namespace slam
