#include "slam/extract/boundary_steps.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace slam {
namespace {

constexpr int kTile_px = 16;
constexpr std::array kReaches_px{4, 7,
                                 10};  // matchers smooth over the pixels nearest to a step

/// Residuals of pixels i and j of labels with planes A and B from the mean of both planes,
/// differenced, in sigmas.
double Step(const DepthGrid& grid, std::size_t i, std::size_t j, const LabelPlane& A,
            const LabelPlane& B) {
  const auto residual = [&](std::size_t k) {
    const auto x = static_cast<double>(grid.x[k]), y = static_cast<double>(grid.y[k]);
    const double mean = 0.5 * (A.plane.InverseDepth(x, y) + B.plane.InverseDepth(x, y));
    return static_cast<double>(grid.q[k]) - mean;
  };
  const double sigmas = 0.5 * (static_cast<double>(grid.g[i]) / A.grazing +
                               static_cast<double>(grid.g[j]) / B.grazing);
  return (residual(i) - residual(j)) * sigmas;
}

}  // namespace

void StepMeasurement::Measure(const DepthGrid& grid, const LabelImage& labels,
                              const LabelRuns& runs, const std::vector<LabelPlane>& planes,
                              BoundarySteps& steps) {
  steps.Clear(static_cast<int>(planes.size()));
  tiles_.resize(static_cast<std::size_t>((grid.width + kTile_px - 1) / kTile_px));
  int last_row = 0;
  // Looks from pixel (u, v) and its neighbour (u + du, v + dv) into their labels.
  VisitContacts(runs, [&](int u, int v, int du, int dv) {
    if (v / kTile_px != last_row / kTile_px) AddTo(steps);
    last_row = v;
    const std::ptrdiff_t i = grid.Index(u, v), stride = grid.Index(du, dv);
    const std::int16_t a = labels[static_cast<std::size_t>(i)];
    const std::int16_t b = labels[static_cast<std::size_t>(i + stride)];
    for (const int reach : kReaches_px) {
      if (u - reach * du < 0 || v - reach * dv < 0) return;
      if (u + (reach + 1) * du >= grid.width || v + (reach + 1) * dv >= grid.height) return;
      const auto in_a = static_cast<std::size_t>(i - reach * stride);
      const auto in_b = static_cast<std::size_t>(i + (reach + 1) * stride);
      if (labels[in_a] != a || labels[in_b] != b) return;
      const double step = Step(grid, in_a, in_b, planes[static_cast<std::size_t>(a)],
                               planes[static_cast<std::size_t>(b)]);
      Sum& sum = SumOf(u / kTile_px, std::minmax<int>(a, b));
      sum.step += a < b ? step : -step, sum.pairs += 1.0;
    }
  });
  AddTo(steps);
}

StepMeasurement::Sum& StepMeasurement::SumOf(int tile, const std::pair<int, int>& labels) {
  std::vector<Sum>& sums = tiles_[static_cast<std::size_t>(tile)];
  const auto found = std::find_if(sums.begin(), sums.end(),
                                  [&](const Sum& sum) { return sum.labels == labels; });
  return found != sums.end() ? *found : sums.emplace_back(Sum{labels, 0.0, 0.0});
}

/// Adds the sums of a row of tiles and forgets them.
void StepMeasurement::AddTo(BoundarySteps& steps) {
  for (std::vector<Sum>& tile : tiles_) {
    for (const Sum& sum : tile) {
      BoundaryStep& step = steps.Of(sum.labels.first, sum.labels.second);
      step.pairs += sum.pairs, step.squares += sum.step * sum.step / sum.pairs;
      step.stretches += 1.0;
    }
    tile.clear();
  }
}

}  // namespace slam
