#include "slam/run/first_look.h"

#include <algorithm>

#include "slam/input/frame_gate.h"
#include "slam/input/frame_of.h"
#include "slam/input/repeated_images.h"

namespace slam {

std::unique_ptr<Tracker> LookFirst(FrameSource& frames, int count, const Camera& camera,
                                   Config config, int threads,
                                   const std::function<bool(int done)>& go_on) {
  config.async_mapping = false;
  auto tracker =
      std::make_unique<Tracker>(camera, config, Variant::kPoints, nullptr, 0, threads);
  FrameGate gate(camera);
  RepeatedImages repeated;
  int index = 0;
  for (int i = 0; i < std::min(count, frames.size()); ++i) {
    RecordedFrame recorded = frames.Read(i);
    if (gate.Takes(recorded)) {
      Frame frame = FrameOf(recorded, index++);
      if (!repeated.Repeats(recorded)) tracker->TrackFrame(frame, recorded.bgr);
    }
    if (!go_on(i + 1)) break;
  }
  return tracker;
}

}  // namespace slam
