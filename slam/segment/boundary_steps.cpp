#include "slam/segment/boundary_steps.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace slam {
namespace {

constexpr int kTile_px = 16;  // a stretch: longer than errors are shared, shorter than bends
// How far from the boundary pixels are compared, beyond what matchers smooth beside a step.
constexpr std::array kReaches_px{4, 7, 10};

/// What two labels' pixels are measured by.
struct Sides {
  std::int16_t a = kNoLabel, b = kNoLabel;
  double slope_x = 0.0, slope_y = 0.0;  ///< mean of both planes
  double half_a = 0.0, half_b = 0.0;    ///< half of a sigma of one pixel, over 1 / g

  Sides() = default;
  Sides(std::int16_t label_a, std::int16_t label_b, const std::vector<LabelPlane>& planes)
      : a(label_a), b(label_b) {
    const LabelPlane& A = planes[static_cast<std::size_t>(a)];
    const LabelPlane& B = planes[static_cast<std::size_t>(b)];
    slope_x = 0.5 * (A.plane.a + B.plane.a), slope_y = 0.5 * (A.plane.b + B.plane.b);
    half_a = 0.5 / A.grazing, half_b = 0.5 / B.grazing;
  }

  /// Residuals of pixels i of a and j of b from that mean, differenced, in sigmas.
  double Step(const DepthGrid& grid, std::size_t i, std::size_t j) const {
    const double dx = static_cast<double>(grid.x[i]) - static_cast<double>(grid.x[j]);
    const double dy = static_cast<double>(grid.y[i]) - static_cast<double>(grid.y[j]);
    const double dq = static_cast<double>(grid.q[i]) - static_cast<double>(grid.q[j]);
    return (dq - (slope_x * dx + slope_y * dy)) *
           (half_a * static_cast<double>(grid.g[i]) + half_b * static_cast<double>(grid.g[j]));
  }
};

}  // namespace

void StepMeasurement::Measure(const DepthGrid& grid, const LabelImage& labels,
                              const LabelRuns& runs, const std::vector<LabelPlane>& planes,
                              BoundarySteps& steps) {
  steps.Clear(static_cast<int>(planes.size()));
  tiles_.resize(static_cast<std::size_t>((grid.width + kTile_px - 1) / kTile_px));
  int last_row = 0;
  Sides sides;
  // Looks from pixel (u, v) and its neighbour (u + du, v + dv) into their labels.
  VisitContacts(runs, [&](int u, int v, int du, int dv) {
    if (v / kTile_px != last_row / kTile_px) AddTo(steps);
    last_row = v;
    const std::ptrdiff_t i = grid.Index(u, v), stride = grid.Index(du, dv);
    const std::int16_t a = labels[static_cast<std::size_t>(i)];
    const std::int16_t b = labels[static_cast<std::size_t>(i + stride)];

    // The steps between pixels as far from the boundary on either side, inside both labels.
    double step = 0.0;
    int pairs = 0;
    for (const int reach : kReaches_px) {
      if (u - reach * du < 0 || v - reach * dv < 0) break;
      if (u + (reach + 1) * du >= grid.width || v + (reach + 1) * dv >= grid.height) break;
      const auto in_a = static_cast<std::size_t>(i - reach * stride);
      const auto in_b = static_cast<std::size_t>(i + (reach + 1) * stride);
      if (labels[in_a] != a || labels[in_b] != b) break;
      if (sides.a != a || sides.b != b) sides = Sides(a, b, planes);
      step += sides.Step(grid, in_a, in_b), ++pairs;
    }
    if (pairs == 0) return;
    Sum& sum = SumOf(u / kTile_px, std::minmax<int>(a, b));
    sum.step += a < b ? step : -step, sum.pairs += pairs;
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
