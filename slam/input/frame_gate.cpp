#include "slam/input/frame_gate.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/input_error.h"
#include "slam/base/median.h"

namespace slam {
namespace {

constexpr float kMaxDepth_m = 1000.0f;  // beyond any sensor

// Stamps of colour and depth are paired to 20 ms. Farther apart they are of two moments or of two
// clocks, and say nothing of how the camera moved in between.
constexpr double kMaxLate_s = 0.05;

bool CanBe(float z_m) { return (z_m >= 0) & (z_m < kMaxDepth_m); }  // false for NaN

// What most of a scene can be away from a camera that measures depth (docs/sensors.md): nearer
// it is blind, farther its depth is mostly noise.
constexpr float kNear_m = 0.4f, kFar_m = 6.0f;

// Something of a scene is nearer than this, the floor if nothing else. A desk at 0.8 m that is
// told in fifths of a millimetre and read in millimetres begins at 3.5 m.
constexpr float kFarBeginning_m = 3.0f;
constexpr std::size_t kOneIn = 20;  // of the pixels may be wrong, and nearer than all there is

struct DepthRange {
  float begin_m = 0.0f, median_m = 0.0f;  ///< 0 when nothing was measured
};

/// Of every 16th pixel of every 16th row: what all but one in twenty are beyond, and the median.
DepthRange RangeOf(const cv::Mat1f& depth_m) {
  constexpr int kStep_px = 16;
  std::vector<float> measured;
  for (int v = 0; v < depth_m.rows; v += kStep_px) {
    for (int u = 0; u < depth_m.cols; u += kStep_px) {
      if (std::isfinite(depth_m(v, u)) && depth_m(v, u) > 0) measured.push_back(depth_m(v, u));
    }
  }
  if (measured.empty()) return {};
  const auto begin = measured.begin() + static_cast<std::ptrdiff_t>(measured.size() / kOneIn);
  std::nth_element(measured.begin(), begin, measured.end());
  const float begin_m = *begin;
  return {begin_m, UpperMedian(std::move(measured))};
}

bool AllCanBe(const cv::Mat1f& depth_m) {
  int can = 0;  // counted without a branch, eight at a time
  for (int v = 0; v < depth_m.rows; ++v) {
    const float* row = depth_m[v];
    for (int u = 0; u < depth_m.cols; ++u) can += CanBe(row[u]) ? 1 : 0;
  }
  return can == depth_m.rows * depth_m.cols;
}

std::string OfFrames(int some, int all) {
  return std::to_string(some) + " of " + std::to_string(all) + " frames";
}

void RequireSize(const cv::Mat& image, const char* what, const Camera& camera, int frame) {
  if (image.cols == camera.width && image.rows == camera.height) return;
  throw io::InputError("frame " + std::to_string(frame),
                       std::string(what) + " image of " + std::to_string(image.cols) + " x " +
                           std::to_string(image.rows) + ", expected " +
                           std::to_string(camera.width) + " x " +
                           std::to_string(camera.height) + " as the camera says");
}

}  // namespace

FrameGate::FrameGate(const Camera& camera) : camera_(camera) {
  const auto positive = [](double x) { return std::isfinite(x) && x > 0; };
  if (positive(camera.fx) && positive(camera.fy) && std::isfinite(camera.cx) &&
      std::isfinite(camera.cy) && camera.width > 0 && camera.height > 0) {
    return;
  }
  throw io::InputError("camera",
                       "fx and fy must be positive and finite, cx and cy finite, and the "
                       "image must have a size");
}

bool FrameGate::Takes(RecordedFrame& frame) {
  RequireSize(frame.gray, "colour", camera_, frame.index);
  RequireSize(frame.bgr, "colour", camera_, frame.index);
  RequireSize(frame.depth_m, "depth", camera_, frame.index);
  if (!std::isfinite(frame.timestamp_s)) {
    throw io::InputError("frame " + std::to_string(frame.index), "its time is not finite");
  }
  if (!first_ && !(frame.timestamp_s > last_s_)) {
    ++not_later_;
    return false;
  }
  if (!(std::abs(frame.depth_late_s) <= kMaxLate_s)) frame.depth_late_s = 0.0;
  // Counted over all frames: a wrong unit of depth shows in most of them.
  first_ = false;
  last_s_ = frame.timestamp_s;
  ++taken_;
  const DepthRange range = RangeOf(frame.depth_m);
  too_near_ += range.median_m > 0 && range.median_m < kNear_m;
  too_far_ += range.median_m > kFar_m;
  begins_far_ += range.begin_m > kFarBeginning_m;
  // The source may still hold the image: mend a copy.
  if (!AllCanBe(frame.depth_m)) {
    frame.depth_m = frame.depth_m.clone();
    for (float& z_m : frame.depth_m) z_m = CanBe(z_m) ? z_m : 0.0f;
  }
  return true;
}

std::vector<std::string> FrameGate::Warnings() const {
  std::vector<std::string> warnings;
  if (not_later_ > 0) {
    warnings.push_back(std::to_string(not_later_) +
                       (not_later_ == 1 ? " frame was" : " frames were") +
                       " left out: not later than the one before");
  }
  const std::string advice = "; is depth_factor of the camera right?";
  if (2 * too_near_ > taken_) {
    warnings.push_back("in " + OfFrames(too_near_, taken_) +
                       " most of the depth is nearer than 0.4 m" + advice);
  }
  if (2 * too_far_ > taken_) {
    warnings.push_back("in " + OfFrames(too_far_, taken_) + " most of the depth is beyond 6 m" +
                       advice);
  } else if (2 * begins_far_ > taken_) {
    warnings.push_back("in " + OfFrames(begins_far_, taken_) +
                       " nearly all of the depth is beyond 3 m" + advice);
  }
  return warnings;
}

}  // namespace slam
