#include "slam/extract/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace slam {
namespace {

constexpr int kGrid_px = 8;
constexpr std::size_t kLines = 5;

}  // namespace

void SightLines::Start(const DepthGrid& grid, const LabelComponents& components,
                       const LabelImage& labels) {
  for (std::vector<Pixel>& samples : samples_) samples.clear();
  if (samples_.size() < components.list.size()) samples_.resize(components.list.size());
  for (std::size_t k = 0; k < components.list.size(); ++k) {
    const int first = components.list[k].first_pixel;
    samples_[k].push_back({first % grid.width, first / grid.width});
  }
  for (int v = 0; v < grid.height; v += kGrid_px) {
    for (int u = 0; u < grid.width; u += kGrid_px) {
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (labels[i] == kNoLabel) continue;
      samples_[static_cast<std::size_t>(components.component[i])].push_back({u, v});
    }
  }
}

double SightLines::ShareBehind(const DepthGrid& grid, const LabelComponents& components,
                               const LabelImage& labels, int a, int b,
                               const LabelPlane& plane) const {
  pairs_.clear();
  for (const Pixel& from : samples_[static_cast<std::size_t>(a)]) {
    Pair nearest{std::numeric_limits<int>::max(), from, from};
    for (const Pixel& to : samples_[static_cast<std::size_t>(b)]) {
      const int du = to.u - from.u, dv = to.v - from.v;
      if (du * du + dv * dv < nearest.distance2) nearest = {du * du + dv * dv, from, to};
    }
    pairs_.push_back(nearest);
  }
  std::stable_sort(pairs_.begin(), pairs_.end(),
                   [](const Pair& p, const Pair& q) { return p.distance2 < q.distance2; });
  int behind = 0, measured = 0;
  for (std::size_t k = 0; k < std::min(kLines, pairs_.size()); ++k) {
    const Pair& line = pairs_[k];
    const int steps = std::max(std::abs(line.b.u - line.a.u), std::abs(line.b.v - line.a.v));
    for (int s = 1; s < steps; ++s) {
      const int u = line.a.u + (line.b.u - line.a.u) * s / steps;
      const int v = line.a.v + (line.b.v - line.a.v) * s / steps;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      if (!(grid.g[i] > 0)) continue;
      const int owner = labels[i] == kNoLabel ? -1 : components.component[i];
      if (owner == a || owner == b) continue;
      ++measured;
      behind += ResidualSigmas(grid, i, plane) < 0 ? 1 : 0;
    }
  }
  return measured > 0 ? static_cast<double>(behind) / measured : 0.0;
}

}  // namespace slam
