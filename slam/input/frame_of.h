#pragma once

#include "slam/input/frame_source.h"
#include "slam/model/frame.h"

namespace slam {

/// A frame as it begins its way through the stages. @param index  count of frames, from 0
inline Frame FrameOf(const RecordedFrame& recorded, int index) {
  Frame frame;
  frame.index = index;
  frame.timestamp_s = recorded.timestamp_s;
  frame.depth_late_s = recorded.depth_late_s;
  frame.gray = recorded.gray;
  frame.depth_m = recorded.depth_m;
  return frame;
}

}  // namespace slam
