#include "slam/faces/line_error.h"

#include <algorithm>
#include <cmath>

namespace slam {
namespace {

constexpr std::size_t kLagParts = 3;  // lags up to a third of the points: few pairs are farther
constexpr double kMinFreeShare = 0.25;  // of the points; keeps the variance finite if all share
constexpr double kUniformParts = 12.0;  // a uniform error of width w has variance w^2 / 12

/// How many neighbours share one error: 1 + 2 sum of autocorrelations up to the first that is
/// not positive; >= 1. Source: Geyer, Practical Markov Chain Monte Carlo, 1992.
double SharedBy(const std::vector<double>& across) {
  const std::size_t n = across.size();
  double square = 0.0;
  for (const double r : across) square += r * r;
  if (!(square > 0)) return 1.0;
  double sum = 1.0;
  for (std::size_t lag = 1; lag < n / kLagParts; ++lag) {
    double product = 0.0;
    for (std::size_t k = lag; k < n; ++k) product += across[k] * across[k - lag];
    if (!(product > 0)) break;
    sum += 2.0 * product / square;
  }
  return sum;
}

}  // namespace

LineError MeasureLineError(const std::vector<Eigen::Vector2d>& points_px,
                           const Eigen::Vector2d& p_px, const Eigen::Vector2d& v) {
  const Eigen::Vector2d normal(-v.y(), v.x());
  std::vector<double> across;
  across.reserve(points_px.size());

  // Residuals across the line, and their lever arms along it.
  double square = 0.0, inertia = 0.0;
  for (const Eigen::Vector2d& u : points_px) {
    const double s = v.dot(u - p_px), r = normal.dot(u - p_px);
    across.push_back(r);
    square += r * r, inertia += s * s;
  }
  const double n = static_cast<double>(points_px.size());
  const double shared = SharedBy(across);
  // The line took two of the independent errors.
  const double variance = square / n * (n / std::max(n - 2.0 * shared, kMinFreeShare * n));

  // What the residuals do not show of the rounding, all points have in common.
  const double cell = std::max(std::abs(normal.x()), std::abs(normal.y()));
  const double common = std::max(0.0, cell * cell / kUniformParts - square / n);
  const double length = std::max((points_px.back() - points_px.front()).norm(), 1.0);
  LineError out;
  out.at_px = p_px;
  out.along = v;
  // Both ends anywhere in their pixel: half of the variance is of the middle.
  out.offset_px2 = variance * shared / n + 0.5 * common;
  out.angle_rad2 =
      variance * shared / std::max(inertia, 1.0) + 2.0 * common / (length * length);
  return out;
}

}  // namespace slam
