#include "slam/segment/sensor_warp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace slam {
namespace {

constexpr std::size_t kMinPieces = 20;  // balances a doubtful median against no answer at all
constexpr double kMedianOfSquare = 0.4549;  // chi-square with one degree of freedom

/// The region of 2 x 2 blocks from (row, column) on; -1: they do not share one.
int RegionOfPiece(const BlockClusters& clusters, int row, int col) {
  const auto first = static_cast<std::size_t>(row * clusters.cols + col);
  const std::size_t below = first + static_cast<std::size_t>(clusters.cols);
  const int region = clusters.region[first];
  const bool shared = clusters.region[first + 1] == region &&
                      clusters.region[below] == region && clusters.region[below + 1] == region;
  return shared ? region : -1;
}

/// Sums of 2 x 2 blocks.
PlaneSums SumPiece(const BlockClusters& clusters, const std::vector<PlaneSums>& blocks, int row,
                   int col) {
  const auto first = static_cast<std::size_t>(row * clusters.cols + col);
  const std::size_t below = first + static_cast<std::size_t>(clusters.cols);
  PlaneSums sums = blocks[first];
  sums += blocks[first + 1];
  sums += blocks[below];
  sums += blocks[below + 1];
  return sums;
}

/// Squared mean residual of a piece in sigmas, which hardly change within it, less what noise
/// adds to its median.
double SquaredMean(const PlaneSums& s, const LabelPlane& p, double correlated_px) {
  const double sum = s.wq - p.plane.a * s.wx - p.plane.b * s.wy - p.plane.c * s.w;
  return sum * sum / (s.w * s.n * p.grazing * p.grazing) -
         kMedianOfSquare * correlated_px / s.n;
}

}  // namespace

double WarpMeasurement::Measure(const BlockClusters& clusters,
                                const std::vector<PlaneSums>& blocks, const DepthNoise& noise,
                                const PlaneExtractionConfig& config) {
  if (!(config.max_warp_sigmas > 0.0)) return 0.0;
  planes_.clear(), squares_.clear();
  for (std::size_t k = 0; k < clusters.planes.size(); ++k) {
    planes_.push_back(
        {clusters.planes[k], GrazingFactor(clusters.sums[k], clusters.planes[k], noise)});
  }
  // The mean residual of every piece that lies in one cluster.
  for (int r = 0; r + 1 < clusters.rows; r += 2) {
    for (int c = 0; c + 1 < clusters.cols; c += 2) {
      const int region = RegionOfPiece(clusters, r, c);
      if (region < 0) continue;
      squares_.push_back(SquaredMean(SumPiece(clusters, blocks, r, c),
                                     planes_[static_cast<std::size_t>(region)],
                                     noise.correlated_px));
    }
  }

  // The median, which few pieces across steps do not move, as a standard deviation.
  if (squares_.size() < kMinPieces) return 0.0;
  const auto middle = squares_.begin() + static_cast<std::ptrdiff_t>(squares_.size() / 2);
  std::nth_element(squares_.begin(), middle, squares_.end());
  const double warp = std::sqrt(std::max(*middle, 0.0) / kMedianOfSquare);
  return std::min(warp, config.max_warp_sigmas);
}

PlaneExtractionConfig AllowWarp(const PlaneExtractionConfig& config, double warp_sigmas) {
  PlaneExtractionConfig allowed = config;
  allowed.coarse.model_error_sigmas += config.warp_model_error * warp_sigmas;
  allowed.fine.model_error_sigmas += config.warp_model_error * warp_sigmas;
  allowed.max_bend_sigmas += config.warp_gap * warp_sigmas;
  allowed.max_hidden_gap_sigmas += config.warp_gap * warp_sigmas;
  if (warp_sigmas > 0.0) {
    allowed.unsure_side_sigmas =
        std::max(config.unsure_side_sigmas, allowed.max_hidden_gap_sigmas);
  }
  return allowed;
}

}  // namespace slam
