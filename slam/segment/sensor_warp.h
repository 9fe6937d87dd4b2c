#pragma once

#include <vector>

#include "slam/segment/block_clusters.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/pixel_labels.h"

namespace slam {

/// How far this frame's sensor bends what is flat, in sigmas of a pixel: what the mean
/// residuals of pieces of the clusters (2 x 2 blocks) scatter by, beyond noise; 0 for a sensor
/// that is as flat as its noise model says. It is the median over the image, which steps or
/// curved things here and there do not move. A warp larger than the clusters' model error is
/// underestimated, because it splits them.
class WarpMeasurement {
 public:
  /// @param clusters  those of the whole grid, with the bounds of a flat sensor
  /// @param blocks    sums of the measured pixels of each of its blocks
  double Measure(const BlockClusters& clusters, const std::vector<PlaneSums>& blocks,
                 const DepthNoise& noise, const PlaneExtractionConfig& config);

 private:
  std::vector<LabelPlane> planes_;  ///< one a cluster
  std::vector<double> squares_;     ///< squared mean residual of each piece
};

/// The bounds that a surface warped by that much keeps; `config` itself for 0.
PlaneExtractionConfig AllowWarp(const PlaneExtractionConfig& config, double warp_sigmas);

}  // namespace slam
