#pragma once

#include <string>
#include <vector>

#include "slam/geometry/camera.h"
#include "slam/input/frame_source.h"

namespace slam {

/// Lets in what the estimator can work with, whatever the stream does.
class FrameGate {
 public:
  /// @throws InputError when the camera cannot be one.
  explicit FrameGate(const Camera& camera);

  /// @param frame  depth that is not finite, negative or beyond any sensor becomes 0, on a copy; so
  ///               does a delay of depth that no pair of images has
  /// @returns whether it is later than all before; otherwise it is counted and left out
  /// @throws InputError when an image is not of the camera's size, or the time is not finite.
  bool Takes(RecordedFrame& frame);

  /// What was left out or looks wrong, a line a kind; empty when nothing does.
  std::vector<std::string> Warnings() const;

 private:
  Camera camera_;
  double last_s_ = 0.0;
  bool first_ = true;
  int not_later_ = 0, taken_ = 0;
  int too_near_ = 0, too_far_ = 0;  ///< frames in which most of the depth is so
  int begins_far_ = 0;              ///< frames that show nothing near
};

}  // namespace slam
