#include "slam/track/frame_gate.h"

#include <algorithm>
#include <cmath>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr float kMaxDepth_m = 1000.0f;

bool CanBe(float z_m) { return z_m >= 0 && z_m < kMaxDepth_m; }  // false for NaN

void RequireSize(const cv::Mat& image, const char* what, const Camera& camera, int frame) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw InputError("frame " + std::to_string(frame),
                   std::string(what) + " image of " + std::to_string(image.cols) + " x " +
                       std::to_string(image.rows) + ", expected " +
                       std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                       " as the camera says");
}

}  // namespace

bool FrameGate::Takes(RecordedFrame& frame) {
  RequireSize(frame.gray, "colour", camera_, frame.index);
  RequireSize(frame.bgr, "colour", camera_, frame.index);
  RequireSize(frame.depth_m, "depth", camera_, frame.index);
  if (!std::isfinite(frame.timestamp_s)) {
    throw InputError("frame " + std::to_string(frame.index), "its time is not finite");
  }
  if (!first_ && !(frame.timestamp_s > last_s_)) {
    ++not_later_;
    return false;
  }
  first_ = false;
  last_s_ = frame.timestamp_s;
  if (!std::all_of(frame.depth_m.begin(), frame.depth_m.end(), CanBe)) {
    frame.depth_m = frame.depth_m.clone();
    for (float& z_m : frame.depth_m) z_m = CanBe(z_m) ? z_m : 0.0f;
  }
  return true;
}

std::vector<std::string> FrameGate::Warnings() const {
  if (not_later_ == 0) return {};
  return {std::to_string(not_later_) + (not_later_ == 1 ? " frame was" : " frames were") +
          " left out: not later than the one before"};
}

}  // namespace slam
