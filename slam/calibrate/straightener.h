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

  /// What depths are to be multiplied with, pixel by pixel (Straightened); empty when there is no
  /// warp to be applied. It stays as it is when more is learnt.
  const cv::Mat1f& factors() const { return factors_; }

  /// Notes whether the frame, of each in order, was straightened.
  void See(const Frame& frame);
  /// Learns from a tracked frame with planes (Frame::measured), for frames after it.
  void Learn(const Frame& frame);

  const StraighteningReport& report() const { return report_; }

 private:
  void Apply(const DepthWarp& warp);

  Camera camera_;
  DepthNoise noise_;
  DepthWarpConfig config_;
  std::optional<WarpLearner> learner_;  ///< from the first frame on that it learns from
  cv::Mat1f factors_;                   ///< empty: nothing is applied
  StraighteningReport report_;
};

}  // namespace slam
