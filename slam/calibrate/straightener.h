#pragma once

#include <optional>

#include "slam/calibrate/warp_learner.h"
#include "slam/model/frame.h"

namespace slam {

/// What became of the depth of a run.
struct StraighteningReport {
  int from_frame = kNone;  ///< index of the first frame that was straightened
  double rms = 0.0;        ///< of the pattern that is applied last, as a part of the depth
  std::optional<WarpEvidence> evidence;  ///< of what was learnt, if anything was to be
};

/// Takes out of the depth of a run what its device bends: by a file, or by what the run itself
/// teaches, from the moment on when that is worth it.
class DepthStraightener {
 public:
  /// @throws InputError of ReadWarp
  DepthStraightener(const Camera& camera, const DepthNoise& noise,
                    const DepthWarpConfig& config);

  /// Goes on from what was learnt of the recording before it is run. Before the first frame.
  void StartFrom(WarpLearner learner);

  /// What is to be done with depth. Its image stays as it is when more is learnt.
  const Straightening& straightening() const { return straightening_; }

  /// Notes whether the frame, of each in order, was straightened.
  void See(const Frame& frame);
  /// Learns from a tracked frame with planes (Frame::measured), for frames after it.
  void Learn(const Frame& frame);

  const StraighteningReport& report() const { return report_; }

 private:
  void Apply(const DepthWarp& warp);
  void ApplyIfWorthIt();

  Camera camera_;
  DepthNoise noise_;
  DepthWarpConfig config_;
  std::optional<WarpLearner> learner_;  ///< from the first frame on that it learns from
  Straightening straightening_;
  StraighteningReport report_;
};

}  // namespace slam
