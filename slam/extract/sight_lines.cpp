#include "slam/extract/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace slam {
namespace {

constexpr int kGrid_px = 8;
constexpr std::size_t kLines = 5;
constexpr float kBehind_sigmas = 2.0f;  // other parts of the plane scatter about it

}  // namespace

SightLines::SightLines(const DepthGrid& grid, const std::vector<int>& part, int part_count)
    : grid_(grid), part_(part), samples_(static_cast<std::size_t>(part_count)) {
  const auto at = [&](int u, int v) {
    return part[static_cast<std::size_t>(grid.Index(u, v))];
  };
  for (int v = 0; v < grid.height; v += kGrid_px) {
    for (int u = 0; u < grid.width; u += kGrid_px) {
      if (at(u, v) >= 0) samples_[static_cast<std::size_t>(at(u, v))].push_back({u, v});
    }
  }
  for (int v = 0; v < grid.height; ++v) {  // what the grid has missed: its first pixel
    int last = -1;
    for (int u = 0; u < grid.width; ++u) {
      const int p = at(u, v);
      if (p == last || p < 0) continue;
      last = p;
      std::vector<Pixel>& samples = samples_[static_cast<std::size_t>(p)];
      if (samples.empty()) samples.push_back({u, v});
    }
  }
}

std::vector<SightLines::Line> SightLines::NearestLines(int a, int b) const {
  std::vector<Line> lines;
  for (const Pixel& from : samples_[static_cast<std::size_t>(a)]) {
    Line nearest{std::numeric_limits<int>::max(), from, from};
    for (const Pixel& to : samples_[static_cast<std::size_t>(b)]) {
      const int du = to.u - from.u, dv = to.v - from.v;
      if (du * du + dv * dv < nearest.length2) nearest = {du * du + dv * dv, from, to};
    }
    lines.push_back(nearest);
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& p, const Line& q) { return p.length2 < q.length2; });
  lines.resize(std::min(lines.size(), kLines));
  return lines;
}

double SightLines::ShareBehind(int a, int b, const LabelPlane& plane) const {
  int behind = 0, measured = 0;
  for (const Line& line : NearestLines(a, b)) {
    const int du = line.to.u - line.from.u, dv = line.to.v - line.from.v;
    const int steps = std::max(std::abs(du), std::abs(dv));
    for (int s = 1; s < steps; ++s) {
      const auto i = static_cast<std::size_t>(
          grid_.Index(line.from.u + du * s / steps, line.from.v + dv * s / steps));
      if (!(grid_.g[i] > 0) || part_[i] == a || part_[i] == b) continue;
      ++measured;
      behind += ResidualSigmas(grid_, i, plane) < -kBehind_sigmas ? 1 : 0;
    }
  }
  return measured > 0 ? static_cast<double>(behind) / measured : 0.0;
}

}  // namespace slam
