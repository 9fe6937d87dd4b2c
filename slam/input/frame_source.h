#pragma once

#include <opencv2/core/mat.hpp>

namespace slam {

/// One frame as recorded: what a camera gives, and no more.
struct RecordedFrame {
  int index = 0;
  double timestamp_s = 0.0;   ///< when the colour image was taken
  double depth_late_s = 0.0;  ///< depth was measured so much later; negative: earlier
  cv::Mat3b bgr;              ///< 8-bit, OpenCV's order of channels
  cv::Mat1b gray;             ///< 8-bit, Rec. 601 luma of bgr
  cv::Mat1f depth_m;          ///< planar z, metres; 0 = no measurement
};

/// Where frames come from: a folder, or a camera in the same process.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual int size() const = 0;
  /// Frame i of [0, size()); the caller asks for each once, in order, of a recording perhaps twice. Timestamps strictly
  /// increase, all images have the camera's size.
  virtual RecordedFrame Read(int i) = 0;
};

}  // namespace slam
