#include "sim/sensor/depth/rounded_sigma.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

#include "sim/sensor/depth/depth_effects.h"

namespace sim {
namespace {

constexpr double kSpacing_m = 2e-5;  ///< a twentieth of the steps where it matters
/// Beyond, a step of disparity is so much larger than one of depth that rounding to the latter
/// no longer counts.
constexpr double kMaxStepRatio = 4.0;
/// Depth range that has a table: coarse steps of a user's own model would need no end of it.
constexpr double kMaxRange_m = 3.0;
constexpr double kSummedTail = 5.0;  ///< sds of noise that are summed
/// A finer grid of disparity, in sds of the noise, is as good as none: Simple's sum is right.
constexpr double kMinGridRatio = 0.1;
constexpr int kRounds = 2;  ///< rounds of the fixed point; the second changes less than 0.3 %

double Simple(double z, const D435Model& m) {
  return SigmaBeforeRounding(m.subpixel_px, m.grid_px,
                             m.rounding_m * m.focal_baseline_px_m / (z * z));
}

/// Variance of the depth that comes out, m^2, when disparity has this sd.
double VarianceOut(double z, double sigma_px, const D435Model& m) {
  double disparity = m.focal_baseline_px_m / z;
  disparity += m.ripple_px * std::sin(2.0 * std::numbers::pi * disparity);
  const auto tick = [&](double d) { return static_cast<long>(std::lround(d / m.grid_px)); };
  const long first = std::max(1L, tick(disparity - kSummedTail * sigma_px));
  const long last = tick(disparity + kSummedTail * sigma_px);
  // Each step of disparity comes out as one depth; the normal law says how often.
  double below = 0, sum = 0, mean = 0, square = 0;
  for (long k = first; k <= last; ++k) {
    const double edge = (static_cast<double>(k) + 0.5) * m.grid_px;
    const double to = k == last ? 1.0 : NormalProbability((edge - disparity) / sigma_px);
    const double share = to - below;
    below = to;
    const double out =
        RoundDepth(m.focal_baseline_px_m / (static_cast<double>(k) * m.grid_px), m.rounding_m) -
        z;
    sum += share;
    mean += share * out;
    square += share * out * out;
  }
  mean /= sum;
  return square / sum - mean * mean;
}

}  // namespace

RoundedSigma::RoundedSigma(const D435Model& model) : model_(model) {
  if (!(model.grid_px > 0 && model.rounding_m > 0 && model.subpixel_px > 0)) return;
  if (model.grid_px < kMinGridRatio * model.subpixel_px) return;
  const double last_m = std::min({model.max_depth_m, model.min_depth_m + kMaxRange_m,
                                  std::sqrt(kMaxStepRatio * model.rounding_m *
                                            model.focal_baseline_px_m / model.grid_px)});
  if (!(last_m > model.min_depth_m) || !(model.min_depth_m > 0)) return;
  first_m_ = model.min_depth_m;
  step_m_ = kSpacing_m;
  const auto count = static_cast<std::size_t>((last_m - first_m_) / step_m_) + 2;
  sigma_px_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double z = first_m_ + static_cast<double>(i) * step_m_;
    const double per_m = model.focal_baseline_px_m / (z * z);
    const double wanted = D435Sigma(z, model), least = model.grid_px / 6;
    // A fixed point: the noise grows by what the variance that comes out still lacks.
    double sigma = Simple(z, model);
    for (int round = 0; round < kRounds; ++round) {
      const double lacks = (wanted * wanted - VarianceOut(z, sigma, model)) * per_m * per_m;
      const double most = 2 * model.subpixel_px * model.subpixel_px;
      sigma = std::sqrt(std::max(std::min(sigma * sigma + lacks, most), least * least));
    }
    sigma_px_.push_back(sigma);
  }
}

double RoundedSigma::At(double z_m) const {
  const double at = step_m_ > 0 ? (z_m - first_m_) / step_m_ : -1.0;
  if (!(at >= 0 && at + 1 < static_cast<double>(sigma_px_.size()))) return Simple(z_m, model_);
  const auto i = static_cast<std::size_t>(at);
  const double t = at - static_cast<double>(i);
  return (1 - t) * sigma_px_[i] + t * sigma_px_[i + 1];
}

std::shared_ptr<const RoundedSigma> RoundedSigma::Of(const D435Model& model) {
  using Key = std::tuple<double, double, double, double, double, double, double>;
  static std::mutex mutex;
  static std::map<Key, std::shared_ptr<const RoundedSigma>> tables;
  const Key key{model.focal_baseline_px_m, model.subpixel_px, model.grid_px,    model.ripple_px,
                model.rounding_m,          model.min_depth_m, model.max_depth_m};
  const std::lock_guard lock(mutex);
  auto& table = tables[key];
  if (!table) table = std::make_shared<const RoundedSigma>(model);
  return table;
}

}  // namespace sim
