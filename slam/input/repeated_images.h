#pragma once

#include "slam/input/frame_source.h"

namespace slam {

/// A driver repeats an image once or twice; what comes again more often is a world that stands
/// still before a camera without noise, of which there is something to learn.
inline constexpr int kMaxRepeats = 2;

/// Finds the frames for which a driver that had nothing new gave its last images again. Noise
/// never repeats itself: colour and depth are then those of the frame before to the last bit.
class RepeatedImages {
 public:
  /// Whether the frame repeats the one asked of before it. Ask of each frame once, in order.
  bool Repeats(const RecordedFrame& frame);

  int count() const { return count_; }

 private:
  cv::Mat3b bgr_;
  cv::Mat1f depth_m_;
  int in_a_row_ = 0, count_ = 0;
};

}  // namespace slam
