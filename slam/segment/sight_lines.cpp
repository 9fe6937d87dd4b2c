#include "slam/segment/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace slam {
namespace {

constexpr int kGrid_px = 8;            // spacing of samples; balances time against small parts
constexpr std::size_t kEnds = 12;      // samples of each part that lines join; balances time
constexpr float kClear_sigmas = 3.0f;  // no other part of the plane scatters so far
constexpr int kClear_px = 3;           // in a row, as single pixels beside an edge may err
/// Of the lines. Not fewer, as a surface need not be convex; from 0.2 to 0.35 little changes.
constexpr double kMaxBehindShare = 0.25;

}  // namespace

SightLines::SightLines(const DepthGrid& grid, const LabelRuns& runs, std::vector<int> part,
                       int part_count)
    : grid_(grid),
      runs_(runs),
      part_(std::move(part)),
      samples_(static_cast<std::size_t>(part_count)) {
  for (int v = 0; v < grid.height; v += kGrid_px) {
    const auto row = static_cast<std::size_t>(v);
    for (std::size_t k = runs.rows[row]; k < runs.rows[row + 1]; ++k) {
      if (part_[k] < 0) continue;
      const LabelRun& run = runs.runs[k];
      for (int u = (run.begin + kGrid_px - 1) / kGrid_px * kGrid_px; u < run.end; u += kGrid_px)
        samples_[static_cast<std::size_t>(part_[k])].push_back({u, v});
    }
  }
}

/// Visits the pixels between the ends until told to stop, without a division: along the longer
/// side one at a time, along the other what the division would have rounded towards `from`.
template <typename Visit>
void SightLines::Walk(const Pixel& from, const Pixel& to, const Visit& visit) const {
  const int du = to.u - from.u, dv = to.v - from.v;
  const int across = du < 0 ? -1 : 1, down = dv < 0 ? -grid_.width : grid_.width;
  const bool is_level = std::abs(du) >= std::abs(dv);
  const int steps = std::max(std::abs(du), std::abs(dv));
  const int shorter = std::min(std::abs(du), std::abs(dv));
  const int always = is_level ? across : down, sometimes = is_level ? down : across;
  int i = grid_.Index(from.u, from.v);
  for (int s = 1, rest = 0; s < steps; ++s) {
    rest += shorter;
    const bool over = rest >= steps;
    rest -= over ? steps : 0;
    i += always + (over ? sometimes : 0);
    if (!visit(static_cast<std::size_t>(i))) return;
  }
}

int SightLines::PartAt(std::size_t i) const {
  const int pixel = static_cast<int>(i);
  return part_[runs_.At(pixel % grid_.width, pixel / grid_.width)];
}

bool SightLines::PassesBehind(const Pixel& from, const Pixel& to, int a, int b,
                              const PixelPlane& plane, float clear) const {
  int behind = 0;  // measured pixels in a row
  Walk(from, to, [&](std::size_t i) {
    if (!(grid_.g[i] > 0)) return true;
    const bool is_behind = ResidualSigmas(grid_, i, plane) < -clear;
    const int part = is_behind ? PartAt(i) : a;
    behind = part != a && part != b ? behind + 1 : 0;
    return behind < kClear_px;
  });
  return behind == kClear_px;
}

bool SightLines::PassBehind(int a, int b, const LabelPlane& plane, double unsure_sigmas) const {
  const std::vector<Pixel>&all_a = samples_[static_cast<std::size_t>(a)],
        &all_b = samples_[static_cast<std::size_t>(b)];
  if (all_a.empty() || all_b.empty()) return true;
  const float clear = std::max(kClear_sigmas, static_cast<float>(unsure_sigmas));
  const PixelPlane in_float(plane);
  const auto end = [](const std::vector<Pixel>& all, std::size_t k) {  // kEnds in equal steps
    return all[all.size() * (2 * k + 1) / (2 * kEnds)];
  };
  // Until what is left cannot change the answer.
  constexpr int kLines = kEnds * kEnds;
  constexpr int kMaxBehind = static_cast<int>(kMaxBehindShare * kLines);
  int behind = 0, beside = 0;
  for (std::size_t j = 0; j < kEnds; ++j) {
    for (std::size_t k = 0; k < kEnds && behind <= kMaxBehind && beside < kLines - kMaxBehind;
         ++k) {
      const bool is = PassesBehind(end(all_a, j), end(all_b, k), a, b, in_float, clear);
      ++(is ? behind : beside);
    }
  }
  return behind > kMaxBehind;
}

}  // namespace slam
