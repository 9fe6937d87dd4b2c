#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "slam/extract/depth_grid.h"
#include "slam/extract/plane_sums.h"

namespace slam {

/// A plane that pixels may belong to.
struct LabelPlane {
  InverseDepthPlane plane;
  double grazing = 1.0;  ///< GrazingFactor of its pixels
};

inline constexpr std::int16_t kNoLabel = -1;
using LabelImage = std::vector<std::int16_t>;  ///< one entry a pixel, kNoLabel or an index

struct GrowthConfig {
  int block_px = 8;               ///< regions spread from block to block; domain [2, 64]
  double max_pixel_sigmas = 3.0;  ///< distance of a plane's pixel from it; domain (0, inf)
  /// A pixel between two planes goes to the one that fits the pixels within this many rows and
  /// columns best: the noise of single pixels must not decide. Domain [0, 16].
  int vote_reach_px = 2;
  /// A plane must explain its pixels better than the next best plane there does, by this much
  /// on average (difference of squared sigmas); otherwise it only steals from its neighbours,
  /// as the plane of a block across a step does. Domain [0, inf).
  double min_gain = 3.0;
};

/// Planes growing over the pixels of an image, from block to block.
///
/// A pixel goes to the nearest plane, in sigmas, among those that have reached its block, if it
/// is nearer than max_pixel_sigmas. A plane that owns pixels of a block reaches the block's 8
/// neighbours. The outcome does not depend on the order of work.
class PixelGrowth {
 public:
  PixelGrowth(const DepthGrid& grid, const GrowthConfig& config);

  /// Adds a plane that may claim pixels at once in `blocks`. @returns its label.
  int AddPlane(const LabelPlane& plane, const std::vector<int>& blocks);
  int BlockAt(int u, int v) const {
    return v / config_.block_px * cols_ + u / config_.block_px;
  }
  /// Spreads the planes added or changed since the last call.
  void Grow();
  /// Takes out the planes that gain less than min_gain, smallest first, and gives their pixels
  /// to the others.
  void DropUseless();
  /// Goes on with other planes for the labels: `planes` in place of the old ones and the pixels
  /// of label k counted as those of into[k]; everything is grown anew from there.
  void Replace(std::vector<LabelPlane> planes, const std::vector<int>& into);

  const LabelImage& labels() const { return labels_; }
  const std::vector<LabelPlane>& planes() const { return planes_; }

 private:
  bool Reach(int block, int label);
  int MeasureBlock(int u0, int v0, int u1, int v1, int label, float* distance) const;
  void LabelBlock(int block, std::vector<int>& owned);
  void SumNeighbourCosts(int u0, int v0, int u1, int v1, const std::vector<int>& candidates);

  const DepthGrid& grid_;
  GrowthConfig config_;
  int cols_, rows_;
  std::vector<LabelPlane> planes_;
  std::vector<std::vector<int>> reached_;  ///< labels of each block, sorted
  std::vector<int> active_;                ///< blocks whose labels changed
  LabelImage labels_;
  // Scratch of LabelBlock.
  std::vector<float> distances_, costs_, row_sums_, cost_row_;
  std::vector<std::size_t> rivals_;
  std::vector<int> rival_labels_;
};

/// Sums of the pixels of each label.
std::vector<PlaneSums> SumLabels(const DepthGrid& grid, const LabelImage& labels, int count);

/// Residual of a pixel from a plane in sigmas; positive: the pixel is nearer than the plane.
inline float ResidualSigmas(const DepthGrid& grid, std::size_t i, const LabelPlane& p) {
  const float predicted = static_cast<float>(p.plane.a) * grid.x[i] +
                          static_cast<float>(p.plane.b) * grid.y[i] +
                          static_cast<float>(p.plane.c);
  return (grid.q[i] - predicted) * grid.g[i] / static_cast<float>(p.grazing);
}

/// A 4-connected set of pixels with one label.
struct LabelComponent {
  int label = 0;
  int pixels = 0;
  int first_pixel = 0;  ///< in row-major order
  /// Measured neighbours across its boundary that lie behind or in front of the label's plane.
  int behind = 0, in_front = 0;
};

/// Connected components of a label image, in order of their first pixel.
struct LabelComponents {
  std::vector<int> component;  ///< of each pixel; -1 where there is no label
  std::vector<LabelComponent> list;
};
LabelComponents ConnectedComponents(const DepthGrid& grid, const LabelImage& labels,
                                    const std::vector<LabelPlane>& planes);

}  // namespace slam
