#include "slam/extract/boundary_steps.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace slam {
namespace {

constexpr int kTile_px = 16;
constexpr std::array kReaches_px{4, 7,
                                 10};  // matchers smooth over the pixels nearest to a step

/// Compares pixels across boundaries that lie in one tile.
class TileSteps {
 public:
  TileSteps(const DepthGrid& grid, const LabelImage& labels,
            const std::vector<LabelPlane>& planes)
      : grid_(grid), labels_(labels), planes_(planes) {}

  /// Looks from pixel (u, v) and its neighbour (u + du, v + dv) into their labels.
  void Look(int u, int v, int du, int dv) {
    const int a = labels_[At(u, v)], b = labels_[At(u + du, v + dv)];
    if (a == b || a == kNoLabel || b == kNoLabel) return;
    for (const int reach : kReaches_px) {
      const int u_a = u - reach * du, v_a = v - reach * dv;
      const int u_b = u + (reach + 1) * du, v_b = v + (reach + 1) * dv;
      if (u_a < 0 || v_a < 0 || u_b >= grid_.width || v_b >= grid_.height) return;
      const std::size_t i = At(u_a, v_a), j = At(u_b, v_b);
      if (labels_[i] != a || labels_[j] != b) return;
      const double step = Step(i, j, a, b);
      Sum& sum = Of(std::minmax(a, b));
      sum.step += a < b ? step : -step, sum.pairs += 1.0;
    }
  }

  /// Whether a row of a whole tile is of one label, and what is below it too.
  bool IsInside(int u, int v) const {
    if (u + kTile_px >= grid_.width || v + 1 >= grid_.height) return false;
    const std::int16_t* row = labels_.data() + At(u, v);
    int differs = 0;
    for (int k = 0; k < kTile_px; ++k)
      differs |= (row[k] ^ row[k + 1]) | (row[k] ^ row[k + grid_.width]);
    return differs == 0;
  }

  void AddTo(BoundarySteps& steps) {
    for (const Sum& sum : sums_) {
      BoundaryStep& step = steps[sum.pair];
      step.pairs += sum.pairs, step.squares += sum.step * sum.step / sum.pairs;
      step.stretches += 1.0;
    }
    sums_.clear();
  }

 private:
  struct Sum {
    std::pair<int, int> pair;
    double step = 0.0, pairs = 0.0;
  };

  std::size_t At(int u, int v) const { return static_cast<std::size_t>(grid_.Index(u, v)); }

  /// Residuals from the mean of both planes, differenced, in sigmas.
  double Step(std::size_t i, std::size_t j, int a, int b) const {
    const LabelPlane &A = planes_[static_cast<std::size_t>(a)],
                     &B = planes_[static_cast<std::size_t>(b)];
    const auto residual = [&](std::size_t k) {
      const auto x = static_cast<double>(grid_.x[k]), y = static_cast<double>(grid_.y[k]);
      const double mean = 0.5 * (A.plane.InverseDepth(x, y) + B.plane.InverseDepth(x, y));
      return static_cast<double>(grid_.q[k]) - mean;
    };
    const double sigmas = 0.5 * (static_cast<double>(grid_.g[i]) / A.grazing +
                                 static_cast<double>(grid_.g[j]) / B.grazing);
    return (residual(i) - residual(j)) * sigmas;
  }

  Sum& Of(const std::pair<int, int>& pair) {
    const auto found = std::find_if(sums_.begin(), sums_.end(),
                                    [&](const Sum& sum) { return sum.pair == pair; });
    return found != sums_.end() ? *found : sums_.emplace_back(Sum{pair, 0.0, 0.0});
  }

  const DepthGrid& grid_;
  const LabelImage& labels_;
  const std::vector<LabelPlane>& planes_;
  std::vector<Sum> sums_;  ///< few: the pairs of one tile
};

}  // namespace

BoundarySteps MeasureSteps(const DepthGrid& grid, const LabelImage& labels,
                           const std::vector<LabelPlane>& planes) {
  BoundarySteps steps;
  TileSteps tile(grid, labels, planes);
  for (int v0 = 0; v0 < grid.height; v0 += kTile_px) {
    for (int u0 = 0; u0 < grid.width; u0 += kTile_px) {
      for (int v = v0; v < std::min(v0 + kTile_px, grid.height); ++v) {
        if (tile.IsInside(u0, v)) continue;
        for (int u = u0; u < std::min(u0 + kTile_px, grid.width); ++u) {
          if (u + 1 < grid.width) tile.Look(u, v, 1, 0);
          if (v + 1 < grid.height) tile.Look(u, v, 0, 1);
        }
      }
      tile.AddTo(steps);
    }
  }
  return steps;
}

}  // namespace slam
