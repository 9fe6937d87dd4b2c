#pragma once

#include <memory>
#include <vector>

#include "sim/sensor/depth/d435_sensor.h"

namespace sim {

/// Noise of disparity that gives D435Sigma after both roundings. Where the steps of disparity
/// and of depth are near a whole ratio (1 : 2 at 0.59 m, 1 : 1 at 0.83 m) their errors go along
/// with the noise instead of adding to it, so the sum of variances of SigmaBeforeRounding is up
/// to 5 % off. Here the variance is the sum over the depths that can come out.
class RoundedSigma {
 public:
  explicit RoundedSigma(const D435Model& model);
  /// Sd of a surface at z, pixels of disparity.
  double At(double z_m) const;

  /// The table of a model, made once a process and shared.
  static std::shared_ptr<const RoundedSigma> Of(const D435Model& model);

 private:
  double first_m_ = 0, step_m_ = 0;
  std::vector<double> sigma_px_;  ///< empty: nothing to correct, one rounding or none matters
  D435Model model_;
};

}  // namespace sim
