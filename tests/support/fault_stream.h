#pragma once

#include <functional>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "slam/input/frame_source.h"
#include "tests/support/textured_world.h"

namespace slam {

/// A frame source whose frames a test has tampered with; what a bad cable, clock, driver or
/// hand does to a camera's stream.
class FaultStream : public FrameSource {
 public:
  explicit FaultStream(std::vector<RecordedFrame> frames) : frames_(std::move(frames)) {}
  int size() const override { return static_cast<int>(frames_.size()); }
  RecordedFrame Read(int i) override {
    // Images are shared between copies of a stream: nobody may write into them.
    RecordedFrame frame = frames_.at(static_cast<std::size_t>(i));
    frame.index = i;
    return frame;
  }

 private:
  std::vector<RecordedFrame> frames_;
};

inline void SetColour(RecordedFrame& frame, const cv::Mat1b& gray) {
  frame.gray = gray;
  cv::cvtColor(gray, frame.bgr, cv::COLOR_GRAY2BGR);
}

/// A frame of a stream that begins at 100 s, 30 frames a second.
inline RecordedFrame StreamFrame(int i, const cv::Mat1b& gray, const cv::Mat1f& depth_m) {
  RecordedFrame frame;
  frame.index = i;
  frame.timestamp_s = 100.0 + i / 30.0;
  frame.depth_m = depth_m;
  SetColour(frame, gray);
  return frame;
}

/// What a camera sees along a way through a printed corner of a room, 30 frames a second; no
/// fault yet. @param T_cw_of of a frame's index
inline std::vector<RecordedFrame> SeenStream(int frames, const TexturedCorner& world,
                                             const std::function<Pose(int)>& T_cw_of,
                                             const Camera& camera = CameraOfSize(320, 240)) {
  std::vector<RecordedFrame> stream;
  for (int i = 0; i < frames; ++i) {
    const Frame seen = world.See(camera, T_cw_of(i), i);
    stream.push_back(StreamFrame(i, seen.gray, seen.depth_m));
  }
  return stream;
}

/// The same along a hand's swing.
inline std::vector<RecordedFrame> CleanStream(int frames,
                                              const TexturedCorner& world = TexturedCorner()) {
  return SeenStream(frames, world, SwingingPose);
}

/// The frames of [from, from + count), each changed on images of its own.
inline std::vector<RecordedFrame> Changed(std::vector<RecordedFrame> stream, int from,
                                          int count,
                                          const std::function<void(RecordedFrame&)>& change) {
  for (int i = from; i < from + count && i < static_cast<int>(stream.size()); ++i) {
    RecordedFrame& frame = stream[static_cast<std::size_t>(i)];
    frame.bgr = frame.bgr.clone();
    frame.gray = frame.gray.clone();
    frame.depth_m = frame.depth_m.clone();
    change(frame);
  }
  return stream;
}

}  // namespace slam
