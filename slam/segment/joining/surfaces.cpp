#include "slam/segment/joining/surfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "slam/base/chi_square.h"

namespace slam {

double BendSigmas(const Surface& surface, const JoinConfig& config) {
  if (!surface.bent || !(surface.sums.n > 0)) return 0.0;
  const double mean2 = surface.sums.wqq / surface.sums.n;  // of inverse depth in its sigmas
  constexpr double kBends = 3.0;  // of a normal variable, passed 1 time in 400
  return kBends * config.bend_ratio * std::sqrt(mean2) / surface.plane.grazing;
}

double SeenBend(const std::vector<PlaneSums>& surfaces, const DepthNoise& noise,
                const JoinConfig& config) {
  constexpr double kMinLarge_px = 4000.0;        // wider than the bend is long
  std::vector<std::pair<double, double>> bends;  // of each surface, with its pixels
  double pixels = 0.0;
  for (const PlaneSums& sums : surfaces) {
    if (sums.n < kMinLarge_px) continue;
    const auto fit = Fit(sums);
    if (!fit) continue;
    const double grazing = GrazingFactor(sums, fit->plane, noise);
    const double excess = fit->error - grazing * grazing * sums.n;
    bends.emplace_back(std::sqrt(std::max(0.0, excess) / sums.wqq), sums.n);
    pixels += sums.n;
  }
  std::sort(bends.begin(), bends.end());
  double below = 0.0;
  for (const auto& [bend, n] : bends) {
    below += n;
    if (2.0 * below >= pixels) return std::min(bend, config.max_seen_ratio * config.bend_ratio);
  }
  return config.bend_ratio;
}

double UnionChi2(const PlaneSums& a, const PlaneSums& b, const DepthNoise& noise,
                 const JoinConfig& config) {
  PlaneSums both = a;
  both += b;
  const auto fit = Fit(both), fit_a = Fit(a), fit_b = Fit(b);
  if (!fit || !fit_a || !fit_b) return std::numeric_limits<double>::infinity();
  const double grazing = GrazingFactor(both, fit->plane, noise);
  const double added = (fit->error - fit_a->error - fit_b->error) / (grazing * grazing);

  // Noise that pixels share counts once for each parameter, the bend with the pixels of both.
  const double gap = config.union_gap_sigmas, bend = config.union_bends * config.bend_ratio;
  const double gap2 = gap * gap + bend * bend * both.wqq / (both.n * grazing * grazing);
  return added / (noise.correlated_px + gap2 * a.n * b.n / both.n);
}

double HiddenUnionCost(const PlaneSums& a, const PlaneSums& b, const DepthNoise& noise,
                       const JoinConfig& config) {
  const double chi2 = UnionChi2(a, b, noise, config);
  if (!(chi2 < kChi2Of3At999)) return std::numeric_limits<double>::infinity();

  // Variance of the distance between the planes at the middle of the smaller part.
  const PlaneSums &small = a.n < b.n ? a : b, &large = a.n < b.n ? b : a;
  const double x = small.wx / small.w - large.wx / large.w,
               y = small.wy / small.w - large.wy / large.w;
  const double xx = large.wxx - large.wx * large.wx / large.w,
               xy = large.wxy - large.wx * large.wy / large.w,
               yy = large.wyy - large.wy * large.wy / large.w;
  const double variance = 1.0 / small.w + 1.0 / large.w +
                          (yy * x * x - 2 * xy * x * y + xx * y * y) / (xx * yy - xy * xy);
  const double pixel = small.n / small.w;  // variance of a pixel
  constexpr double kParameters = 3.0;
  return chi2 + 0.5 * kParameters * std::log(noise.correlated_px * variance / pixel);
}

}  // namespace slam
