#include "slam/extract/sensor_warp.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace slam {
namespace {

constexpr std::size_t kLeastPieces = 20;
constexpr double kMedianOfSquare = 0.4549;  // of a chi-square with one degree of freedom

/// The region of 2 x 2 blocks from (row, column) on; -1: they do not share one.
int RegionOfPiece(const BlockClusters& clusters, int row, int col) {
  const auto first = static_cast<std::size_t>(row * clusters.cols + col);
  const std::size_t below = first + static_cast<std::size_t>(clusters.cols);
  const int region = clusters.region[first];
  const bool shared = clusters.region[first + 1] == region &&
                      clusters.region[below] == region && clusters.region[below + 1] == region;
  return shared ? region : -1;
}

/// Squared mean residual of a piece, less what noise adds to its median.
double SquaredMean(const DepthGrid& grid, const cv::Rect& area, const LabelPlane& plane,
                   double correlated_px) {
  double sum = 0.0, n = 0.0;
  for (int v = area.y; v < area.y + area.height; ++v) {
    for (int u = area.x; u < area.x + area.width; ++u) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (!(grid.g[i] > 0)) continue;
      sum += static_cast<double>(ResidualSigmas(grid, i, plane)), n += 1.0;
    }
  }
  return sum * sum / (n * n) - kMedianOfSquare * correlated_px / n;
}

}  // namespace

double MeasureWarp(const DepthGrid& grid, const BlockClusters& clusters,
                   const PlaneExtractionConfig& config) {
  if (!(config.max_warp_sigmas > 0.0)) return 0.0;
  std::vector<LabelPlane> planes;
  for (std::size_t k = 0; k < clusters.planes.size(); ++k) {
    planes.push_back({clusters.planes[k],
                      GrazingFactor(clusters.sums[k], clusters.planes[k], config.noise)});
  }
  const cv::Rect image(0, 0, grid.width, grid.height);
  const int size = clusters.block_px;
  std::vector<double> squares;
  for (int r = 0; r + 1 < clusters.rows; r += 2) {
    for (int c = 0; c + 1 < clusters.cols; c += 2) {
      const int region = RegionOfPiece(clusters, r, c);
      if (region < 0) continue;
      const cv::Rect area = cv::Rect(c * size, r * size, 2 * size, 2 * size) & image;
      squares.push_back(SquaredMean(grid, area, planes[static_cast<std::size_t>(region)],
                                    config.noise.correlated_px));
    }
  }
  if (squares.size() < kLeastPieces) return 0.0;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  const double warp = std::sqrt(std::max(*middle, 0.0) / kMedianOfSquare);
  return std::min(warp, config.max_warp_sigmas);
}

PlaneExtractionConfig AllowWarp(const PlaneExtractionConfig& config, double warp_sigmas) {
  PlaneExtractionConfig allowed = config;
  allowed.coarse.model_error_sigmas += config.warp_model_error * warp_sigmas;
  allowed.fine.model_error_sigmas += config.warp_model_error * warp_sigmas;
  allowed.max_bend_sigmas += config.warp_gap * warp_sigmas;
  allowed.max_hidden_gap_sigmas += config.warp_gap * warp_sigmas;
  if (warp_sigmas > 0.0)
    allowed.unsure_side_sigmas =
        std::max(config.unsure_side_sigmas, allowed.max_hidden_gap_sigmas);
  return allowed;
}

}  // namespace slam
