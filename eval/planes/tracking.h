#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

namespace eval {

/// What one frame shows and what the run says it shows; ids of a frame are all different.
struct TrackingFrame {
  std::vector<int> truth_ids;
  std::vector<int> predicted_ids;
  Eigen::MatrixXd similarity;  ///< truths x predictions, IoU of the masks in [0, 1]
};

/// Ids of a whole sequence as rising indices from 0.
struct TrackingIndices {
  std::map<int, int> truth, predicted;
};
TrackingIndices NumberIds(const std::vector<TrackingFrame>& frames);

/// The similarity from which on CLEAR and Identity match.
inline constexpr double kMatchThreshold = 0.5;

/// part / whole, 0 where there is no whole.
double SafeRatio(double part, double whole);

}  // namespace eval
