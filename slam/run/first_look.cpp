#include "slam/run/first_look.h"

#include <algorithm>

#include "slam/input/frame_gate.h"
#include "slam/input/frame_of.h"
#include "slam/input/repeated_images.h"
#include "slam/segment/plane_segments.h"

namespace slam {
namespace {

/// Learns how the device bends what is flat from the planes of tracked frames, as they are measured.
class BendLook {
 public:
  BendLook(const Camera& camera, const Config& config)
      : extractor_(PixelRays(camera), config.sensor, config.plane_extraction),
        learner_(camera, config.sensor.noise, config.depth_warp) {}

  void See(Frame& frame) {
    const Pose T_dw = frame.T_dc() * frame.T_cw;
    if (!learner_.Wants(frame.timestamp_s, T_dw)) return;
    extractor_.Extract(frame);
    learner_.Observe(frame.timestamp_s, frame.measured.depth_m, frame.plane_labels, T_dw);
  }
  const WarpLearner& learner() const { return learner_; }

 private:
  PlaneExtractor extractor_;
  WarpLearner learner_;
};

}  // namespace

FirstLook LookFirst(FrameSource& frames, int count, const Camera& camera, Config config,
                    bool with_planes, int threads, const std::function<bool(int done)>& go_on) {
  config.async_mapping = false;
  FirstLook look;
  look.tracker =
      std::make_unique<Tracker>(camera, config, Variant::kPoints, nullptr, 0, threads);
  std::optional<BendLook> bend;
  if (with_planes && config.depth_warp.Learns()) bend.emplace(camera, config);
  FrameGate gate(camera);
  RepeatedImages repeated;
  int index = 0;
  for (int i = 0; i < std::min(count, frames.size()); ++i) {
    RecordedFrame recorded = frames.Read(i);
    if (gate.Takes(recorded)) {
      Frame frame = FrameOf(recorded, index++);
      if (!repeated.Repeats(recorded) &&
          look.tracker->TrackFrame(frame, recorded.bgr).tracked && bend) {
        bend->See(frame);
      }
    }
    if (!go_on(i + 1)) break;
  }
  if (bend) look.bend = bend->learner();
  return look;
}

}  // namespace slam
