#include "slam/segment/sight_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "slam/base/index.h"

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
        samples_[Index(part_[k])].push_back({u, v});
    }
  }
}

int SightLines::PartAt(std::size_t i) const {
  const int pixel = static_cast<int>(i);
  return part_[runs_.At(pixel % grid_.width, pixel / grid_.width)];
}

bool SightLines::PassesBehind(const cv::Point& from, const cv::Point& to, int a, int b,
                              const PixelPlane& plane, float clear) const {
  // Pixel s of the line: along the longer side s on, along the other what is rounded towards `from`.
  const int du = to.x - from.x, dv = to.y - from.y;
  const int across = du < 0 ? -1 : 1, down = dv < 0 ? -grid_.width : grid_.width;
  const bool is_level = std::abs(du) >= std::abs(dv);
  const int steps = std::max({std::abs(du), std::abs(dv), 1});
  const int shorter = std::min(std::abs(du), std::abs(dv));
  const int always = is_level ? across : down, sometimes = is_level ? down : across;
  constexpr int kFraction = 22;  // bits
  const std::int64_t slope = ((std::int64_t{shorter} << kFraction) + steps - 1) / steps;
  const int first = grid_.Index(from.x, from.y);
  const auto is_behind = [&](int s) {
    const auto i = static_cast<std::size_t>(
        first + s * always + static_cast<int>(s * slope >> kFraction) * sometimes);
    if (!(grid_.g[i] > 0) || !(ResidualSigmas(grid_, i, plane) < -clear)) return false;
    const int part = PartAt(i);
    return part != a && part != b;
  };
  // Any run of kClear_px pixels contains one of every kClear_px-th.
  for (int s = kClear_px; s < steps; s += kClear_px) {
    if (!is_behind(s)) continue;
    int row = 1;
    for (int before = s - 1; before > s - kClear_px && is_behind(before); --before) ++row;
    for (int after = s + 1; after < steps && row < kClear_px && is_behind(after); ++after)
      ++row;
    if (row >= kClear_px) return true;
  }
  return false;
}

bool SightLines::PassBehind(int a, int b, const LabelPlane& plane, double unsure_sigmas) const {
  const std::vector<cv::Point>&all_a = samples_[Index(a)], &all_b = samples_[Index(b)];
  if (all_a.empty() || all_b.empty()) return true;
  const float clear = std::max(kClear_sigmas, static_cast<float>(unsure_sigmas));
  const PixelPlane in_float(plane);
  const auto end = [](const std::vector<cv::Point>& all,
                      std::size_t k) {  // kEnds in equal steps
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
