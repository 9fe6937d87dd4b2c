#include "slam/run/frames_ahead.h"

#include <utility>

#include "slam/input/frame_of.h"

namespace slam {

FramesAhead::FramesAhead(FrameSource& source, int count, const Camera& camera, Tracker& tracker,
                         int threads)
    : source_(source), count_(count), tracker_(tracker), threads_(threads), gate_(camera) {}

std::optional<FrameAhead> FramesAhead::Next() {
  if (!ahead_.valid() && MayGoOn()) Begin();
  if (!ahead_.valid()) return std::nullopt;
  FrameAhead now = ahead_.get();
  ++given_;
  if (MayGoOn()) Begin();
  return now;
}

/// On one thread a frame is made when it is asked for, with what was known here.
void FramesAhead::Begin() {
  const auto where = threads_ > 1 ? std::launch::async : std::launch::deferred;
  ahead_ = std::async(where, [this, i = begun_++, straightening = tracker_.HowToStraighten()] {
    return ReadAndExtract(i, straightening);
  });
}

FrameAhead FramesAhead::ReadAndExtract(int i, const Straightening& straightening) {
  FrameAhead ahead;
  RecordedFrame recorded = source_.Read(i);
  ahead.taken = gate_.Takes(recorded);
  if (!ahead.taken) return ahead;
  ahead.frame = FrameOf(recorded, indices_);
  ahead.repeats = repeated_.Repeats(recorded);
  if (ahead.repeats) return ahead;
  ++indices_;
  tracker_.Extract(straightening, recorded.bgr, ahead.frame, ahead.times);
  return ahead;
}

}  // namespace slam
