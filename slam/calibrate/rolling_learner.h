#pragma once

#include <optional>
#include <vector>

#include "slam/calibrate/rolling_config.h"
#include "slam/geometry/camera.h"
#include "slam/model/feature_scale.h"
#include "slam/model/map.h"

namespace slam {

/// How long the colour camera takes from its first row to its last; negative: the last one first.
struct RollingEstimate {
  double read_s = 0.0;
  double sigma_s = 0.0;    ///< standard deviation of that
  double applied_s = 0.0;  ///< what is taken out: that, beside what is usual
  int epochs = 0;          ///< that it was measured in
};

/// Learns how long a colour camera with a rolling shutter reads an image.
///
/// While the camera moves, a row that is read later shows points farther on, so what the pose
/// leaves of the distances between points and features goes with the row and with the camera's
/// speed. Map points carry the same error of the keyframes that saw them, which is known, too:
/// where the camera moves as it did then the two are one, and nothing is learnt. Each frame is a
/// linear regression on one number, beside the six of its pose; frames make up epochs of equal
/// information, and how much epochs scatter tells how well the number is known.
///
/// Deterministic.
class RollingLearner {
 public:
  RollingLearner(const Camera& camera, const FeatureScale& scale, const RollingConfig& config);

  /// Learns from the points that a tracked frame was matched with, before the map learns from it.
  void Learn(const Frame& frame, const Map& map);

  /// What is to be taken out of an image that is read while the camera moves so.
  Readout ReadoutAt(const Vector6d& speed) const;
  /// What is known by now stays as it is, for a map that is made with it throughout.
  /// @pre there is an estimate
  void Hold() { held_ = true; }

  /// None before enough epochs.
  const std::optional<RollingEstimate>& estimate() const { return estimate_; }

 private:
  /// A sum of regressions: information on the time, and the same times the time.
  struct Evidence {
    double information = 0.0, weighted_s = 0.0;
    double read_s() const { return weighted_s / information; }
  };
  std::optional<Evidence> EvidenceOf(const Frame& frame, const Map& map) const;
  void CloseEpoch();

  Camera camera_;
  FeatureScale scale_;
  RollingConfig config_;
  Evidence epoch_;
  std::vector<Evidence> epochs_;
  std::optional<RollingEstimate> estimate_;
  bool held_ = false;
};

}  // namespace slam
