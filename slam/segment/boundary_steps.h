#pragma once

#include <utility>
#include <vector>

#include "slam/segment/depth_grid.h"
#include "slam/segment/label_pairs.h"
#include "slam/segment/label_runs.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// The step measured across the common boundary of two labels: what the pixels on one side
/// differ by from those on the other, as far from the boundary, once their mean slope is taken
/// off. A crease or a bend has none, however ill the two planes fit near it.
struct BoundaryStep {
  double pairs = 0.0;  ///< how many pairs of pixels were compared
  double squares =
      0.0;  ///< sum over the pairs of their stretch's mean step, squared, in sigmas
  double stretches = 0.0;  ///< pieces of the boundary, each within a tile of the image

  /// Mean squared step in sigmas of one pixel, less what noise adds to it; may be negative.
  double MeanSquare(double correlated_px) const {
    return (squares - 2.0 * correlated_px * stretches) / pairs;
  }
};

/// Steps between labels that touch. Pairs of labels too narrow to look into are not in it.
using BoundarySteps = LabelPairs<BoundaryStep>;

/// Measures them. The memory of one image serves the next.
class StepMeasurement {
 public:
  /// @param labels  one a pixel
  /// @param runs    runs of these labels
  /// @param steps   what is found; what was in it is forgotten
  void Measure(const DepthGrid& grid, const LabelImage& labels, const LabelRuns& runs,
               const std::vector<LabelPlane>& planes, BoundarySteps& steps);

 private:
  struct Sum {
    std::pair<int, int> labels;
    double step = 0.0, pairs = 0.0;
  };
  Sum& SumOf(int tile, const std::pair<int, int>& labels);
  void AddTo(BoundarySteps& steps);

  std::vector<std::vector<Sum>> tiles_;  ///< a row of tiles; few pairs in each
};

}  // namespace slam
