#include "slam/calibrate/straightener.h"

#include <cmath>
#include <utility>

#include "slam/calibrate/warp_file.h"

namespace slam {
namespace {

constexpr const char* kOff = "off";

}  // namespace

DepthStraightener::DepthStraightener(const Camera& camera, const DepthNoise& noise,
                                     const DepthWarpConfig& config)
    : camera_(camera), noise_(noise), config_(config) {
  if (config.source != kOff && !config.Learns()) Apply(ReadWarp(config.source, camera));
}

void DepthStraightener::Apply(const DepthWarp& warp) {
  // What changes over time no warp takes out.
  const double drift_rms = config_.bend_rms * std::sqrt(config_.drift_share);
  straightening_ = StraighteningBy(warp);
  straightening_.left_ratio = std::hypot(drift_rms, warp.SigmaRms());
  report_.rms = warp.Rms();
}

void DepthStraightener::See(const Frame& frame) {
  const bool straightened = frame.depth_m.data != frame.measured.depth_m.data;
  if (straightened && report_.from_frame == kNone) report_.from_frame = frame.index;
}

void DepthStraightener::Learn(const Frame& frame) {
  const DepthImage& measured = frame.measured;
  if (!config_.Learns() || measured.labels.empty()) return;
  if (!learner_) learner_.emplace(camera_, noise_, config_);
  if (!learner_->Observe(frame.timestamp_s, measured.depth_m, measured.labels,
                         frame.T_dc() * frame.T_cw))
    return;
  ApplyIfWorthIt();
}

void DepthStraightener::StartFrom(WarpLearner learner) {
  learner_ = std::move(learner);
  ApplyIfWorthIt();
}

void DepthStraightener::ApplyIfWorthIt() {
  report_.evidence = learner_->evidence();
  if (learner_->evidence().worth_it) {
    Apply(learner_->Warp());
  } else {
    straightening_ = {};
  }
}

}  // namespace slam
