#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "slam/calibrate/warp_estimate.h"
#include "slam/geometry/pose.h"
#include "slam/geometry/sensor_model.h"

namespace slam {

/// What speaks for and against a learnt warp.
struct WarpEvidence {
  BendLaw law = BendLaw::kDepth;  ///< the one by which more was foretold
  int epochs = 0;                 ///< that were foretold by those before
  double gain = 0.0;              ///< mean over them of the share of variance that was foretold
  double student_t = 0.0;         ///< of that mean
  double min_student_t = 0.0;     ///< that it has to exceed
  double largest_surface = 0.0;   ///< share of all observations that one surface has
  bool worth_it = false;

  /// Why it is not worth it, in words; empty when it is.
  std::string Doubt() const;
};

/// Learns from the frames of a run how its device bends what is flat, and says when that is
/// worth being applied: when what was learnt before foretells, at a level of 0.001, what is seen
/// from other places later, on more than one surface. It learns by each law how the bend goes with
/// the distance, and goes by the one that foretells more.
///
/// Deterministic; a frame that is not used costs nothing.
class WarpLearner {
 public:
  WarpLearner(const Camera& camera, const DepthNoise& noise, const DepthWarpConfig& config);

  /// Whether a frame is later than the last that was used and shows something new; Observe does
  /// nothing otherwise.
  bool Wants(double timestamp_s, const Pose& T_cw) const;

  /// @param depth_m  as measured, not straightened; labels: see Frame::plane_labels
  /// @returns whether Warp() has changed
  bool Observe(double timestamp_s, const cv::Mat1f& depth_m, const cv::Mat1b& labels,
               const Pose& T_cw);
  /// After the last frame: learns from what was seen since the last epoch.
  void Finish();

  const WarpEvidence& evidence() const { return evidence_; }
  /// What is learnt so far, worth it or not.
  DepthWarp Warp() const;

 private:
  struct SeenSurface {
    Plane pi_w;
    double cells = 0.0;
  };
  struct Place {
    double timestamp_s = 0.0;
    Pose T_cw;
  };

  double Shift(const Place& from, const Pose& T_cw) const;
  bool EndsEpoch(double timestamp_s, const Pose& T_cw) const;
  void CountSurface(const SurfaceView& view, const Pose& T_cw);
  void CloseEpoch();
  WarpEvidence EvidenceOf(BendLaw law) const;
  const WarpEstimate& best() const {
    return estimates_[static_cast<std::size_t>(evidence_.law)];
  }

  WarpCells cells_;
  cv::Mat2d rays_;
  DepthNoise noise_;
  std::array<WarpEstimate, 2> estimates_;  ///< by BendLaw

  double depth_m_ = 1.0;       ///< of what was seen last
  double first_s_ = 0.0;       ///< time of the first view
  std::optional<Place> last_;  ///< of the last view that was used
  Place epoch_start_;
  int views_ = 0;                             ///< in the open epoch
  std::array<std::vector<double>, 2> gains_;  ///< by BendLaw
  std::vector<SeenSurface> surfaces_;
  WarpEvidence evidence_;
};

}  // namespace slam
