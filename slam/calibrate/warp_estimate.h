#pragma once

#include <Eigen/Core>
#include <vector>

#include "slam/calibrate/surface_views.h"
#include "slam/calibrate/warp_config.h"

namespace slam {

/// The pattern of a device as it follows from views of flat surfaces: a recursive linear
/// least-squares estimate in information form.
///
/// A cell i of a view obeys q_i (1 + p_i g_i) = a x_i + b y_i + c, g_i the growth of the bend with the
/// depth 1 / q_i (BendGrowth), with a plane (a, b, c) of its own for every surface of every view,
/// which is eliminated. p is a sum of smooth modes whose
/// coefficients are independent with variance 1 beforehand. What changes over time is held as
/// noise: in each epoch (a second or more) the device shows p + d, with a d of its own that has
/// p's modes and drift_share of their power. (docs/calibration.md)
class WarpEstimate {
 public:
  WarpEstimate(const WarpCells& cells, const Camera& camera, const DepthWarpConfig& config,
               BendLaw law);

  /// Adds a surface of a view to the open epoch.
  void Add(const SurfaceView& view);

  /// Ends the epoch and learns from it.
  /// @returns the share of its residuals' variance that the estimate from the epochs before
  ///   took out: a prediction that owes nothing to this epoch; 0 for the first
  double CloseEpoch();

  BendLaw law() const { return law_; }
  int epochs() const { return epochs_; }
  /// p of each cell, and its standard deviation; zero and the expected bend before any epoch.
  const Eigen::VectorXd& pattern() const { return pattern_; }
  const Eigen::VectorXd& sigma() const { return sigma_; }
  /// Standard deviation of what the device shows at a time, drift included, from pattern().
  Eigen::VectorXd spread() const {
    return (sigma_.array().square() + drift_rms_ * drift_rms_).sqrt();
  }

 private:
  void Solve();

  BendLaw law_;
  double drift_rms_;        ///< of what changes over time
  double drift_;            ///< power of drift over that of the fixed pattern
  Eigen::MatrixXd modes_;   ///< a column a mode: its value at each cell, one standard deviation
  Eigen::VectorXd beyond_;  ///< variance of p at each cell that the modes do not have

  // Of all epochs that are closed.
  Eigen::MatrixXd information_;
  Eigen::VectorXd information_vector_, coefficients_, pattern_, sigma_;
  int epochs_ = 0;

  // Of the open epoch.
  Eigen::VectorXd weight_, weighted_;           ///< sums over its views at each cell
  std::vector<Eigen::RowVectorXd> eliminated_;  ///< what the planes of views take away
  double squares_ = 0.0;                        ///< weighted sum of squared residuals
};

/// Takes out of a pattern its best fit that is linear in the pixel.
Eigen::VectorXd WithoutLinearPart(const WarpCells& cells, const Eigen::VectorXd& pattern);

}  // namespace slam
