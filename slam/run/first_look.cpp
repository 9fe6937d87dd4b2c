#include "slam/run/first_look.h"

#include <algorithm>
#include <future>
#include <utility>

#include "slam/run/frames_ahead.h"
#include "slam/segment/plane_segments.h"

namespace slam {
namespace {

/// Learns how the device bends what is flat from the planes of tracked frames, as they are measured,
/// while the next frames are tracked.
class BendLook {
 public:
  BendLook(const Camera& camera, const Config& config, int threads)
      : extractor_(PixelRays(camera), config.sensor, config.plane_extraction),
        learner_(camera, config.sensor.noise, config.depth_warp),
        where_(threads > 1 ? std::launch::async : std::launch::deferred) {}

  void See(Frame frame) {
    FinishFrame();
    const Pose T_dw = frame.T_dc() * frame.T_cw;
    if (!learner_.Wants(frame.timestamp_s, T_dw)) return;
    learning_ = std::async(where_, [this, frame = std::move(frame), T_dw]() mutable {
      extractor_.Extract(frame);
      learner_.Observe(frame.timestamp_s, frame.measured.depth_m, frame.plane_labels, T_dw);
    });
  }
  WarpLearner Learnt() {
    FinishFrame();
    return learner_;
  }

 private:
  void FinishFrame() {
    if (learning_.valid()) learning_.get();
  }

  PlaneExtractor extractor_;
  WarpLearner learner_;
  std::launch where_;
  std::future<void> learning_;  ///< last: its thread uses the rest
};

}  // namespace

FirstLook LookFirst(FrameSource& frames, int count, const Camera& camera, Config config,
                    bool with_planes, int threads, const std::function<bool(int done)>& go_on) {
  config.async_mapping = false;
  FirstLook look;
  look.tracker =
      std::make_unique<Tracker>(camera, config, Variant::kPoints, nullptr, 0, threads);
  std::optional<BendLook> bend;
  if (with_planes && config.depth_warp.Learns()) bend.emplace(camera, config, threads);
  FramesAhead ahead(frames, std::min(count, frames.size()), camera, *look.tracker, threads);
  while (std::optional<FrameAhead> now = ahead.Next()) {
    if (now->taken && !now->repeats && look.tracker->Track(now->frame, now->times).tracked &&
        bend) {
      bend->See(std::move(now->frame));
    }
    if (!go_on(ahead.given())) break;
  }
  if (bend) look.bend = bend->Learnt();
  return look;
}

}  // namespace slam
