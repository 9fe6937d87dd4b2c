#include "slam/segment/seam_search.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "slam/segment/measured_segments.h"

namespace slam {
namespace {

constexpr int kSeamDirections = 12;
constexpr int kRefinements = 2;       // each halves the step between directions
constexpr double kCoarseShare = 0.6;  // of the gain is there though line and direction are off
constexpr double kNoSeam = std::numeric_limits<double>::infinity();

double ErrorOf(const PlaneSums& sums) {
  const std::optional<PlaneFit> fit = Fit(sums);
  return fit ? fit->error : kNoSeam;
}

}  // namespace

/// Tries the lines across one direction.
void SeamSearch::TryDirection(const std::vector<SeamCell>& cells, double step_px,
                              double angle_rad) {
  const Seam across{std::cos(angle_rad), std::sin(angle_rad), 0.0};
  double low = kNoSeam, high = -kNoSeam;
  for (const SeamCell& cell : cells) {
    const double t = across.Beyond(cell.u, cell.v);
    low = std::min(low, t), high = std::max(high, t);
  }
  low -= 0.5 * step_px;
  strips_.assign(static_cast<std::size_t>((high - low) / step_px) + 1, {});
  for (const SeamCell& cell : cells) {
    const double t = (across.Beyond(cell.u, cell.v) - low) / step_px;
    strips_[static_cast<std::size_t>(t)] += cell.sums;
  }
  PlaneSums below;
  for (std::size_t k = 0; k + 1 < strips_.size(); ++k) {
    below += strips_[k];
    if (below.n < bounds_.min_pixels) continue;
    if (all_.n - below.n < bounds_.min_pixels) break;
    const double error = ErrorOf(below) + ErrorOf(Without(all_, below));
    if (!(error < least_error_)) continue;
    least_error_ = error, best_angle_rad_ = angle_rad;
    best_ = across;
    best_.at_px = low + static_cast<double>(k + 1) * step_px;
  }
}

std::optional<Seam> SeamSearch::Find(const std::vector<SeamCell>& small,
                                     const std::vector<SeamCell>& large, double small_px,
                                     const Bounds& bounds) {
  bounds_ = bounds;
  least_error_ = kNoSeam;
  all_ = {};
  for (const SeamCell& cell : large) all_ += cell.sums;
  const double one_plane = ErrorOf(all_);
  double step_rad = std::numbers::pi / kSeamDirections;
  for (int k = 0; k < kSeamDirections; ++k) TryDirection(large, 2.0 * small_px, k * step_rad);
  if (!(one_plane - least_error_ > kCoarseShare * bounds.min_gain)) return std::nullopt;
  TryDirection(small, small_px, best_angle_rad_);
  for (int k = 0; k < kRefinements; ++k) {
    step_rad *= 0.5;
    const double around = best_angle_rad_;
    TryDirection(small, small_px, around - step_rad);
    TryDirection(small, small_px, around + step_rad);
  }
  if (!(one_plane - least_error_ > bounds.min_gain)) return std::nullopt;
  return best_;
}

}  // namespace slam
