#include "slam/segment/surfaces.h"

#include <algorithm>
#include <cmath>

#include "slam/base/chi_square.h"

namespace slam {

double BendSigmas(const Surface& surface, const JoinConfig& config) {
  if (!surface.bent || !(surface.sums.n > 0)) return 0.0;
  const double mean2 = surface.sums.wqq / surface.sums.n;  // of inverse depth in its sigmas
  return config.max_hidden_bends * config.bend_ratio * std::sqrt(mean2) / surface.plane.grazing;
}

double SurfaceGap(const Surface& a, const Surface& b, const DepthNoise& noise,
                  const JoinConfig& config) {
  const Surface& smaller = a.sums.n < b.sums.n ? a : b;
  const double bend = std::max(BendSigmas(a, config), BendSigmas(b, config));
  const double gap2 = MeanSquaredGap(smaller.sums, a.plane.plane, b.plane.plane) /
                      (smaller.plane.grazing * smaller.plane.grazing);
  return gap2 / (config.max_gap_sigmas * config.max_gap_sigmas + bend * bend +
                 kChi2Of3At999 * noise.correlated_px / smaller.sums.n);
}

}  // namespace slam
