#pragma once

#include <Eigen/Cholesky>
#include <cmath>
#include <optional>
#include <vector>

namespace eval {

/// A system that errs by more than so many of its own standard deviations does not know it.
inline constexpr double kSilentSigmas = 5.0;

/// Squared errors by their own covariance (NEES, Bar-Shalom): e^T C^-1 e, which is chi-square
/// distributed where the covariance is honest, with as many degrees of freedom as e has numbers.
struct Nees {
  double mean = 0.0, median = 0.0;
  double inside = 0.0;  ///< share in the middle 95 % of that distribution
  double above = 0.0;   ///< share above them
};

/// The middle 95 % of chi-square.
struct ChiSquareBand {
  double low, high;
};
inline constexpr ChiSquareBand kBandOf3{0.2157953, 9.3484036};
inline constexpr ChiSquareBand kBandOf6{1.2373442, 14.4493753};

/// e^T C^-1 e; nothing where the covariance is singular.
template <int kSize>
std::optional<double> NeesOf(const Eigen::Matrix<double, kSize, 1>& e,
                             const Eigen::Matrix<double, kSize, kSize>& C) {
  const Eigen::LLT<Eigen::Matrix<double, kSize, kSize>> root(C);
  if (root.info() != Eigen::Success) return std::nullopt;
  const double nees = root.matrixL().solve(e).squaredNorm();
  return std::isfinite(nees) ? std::optional(nees) : std::nullopt;
}

/// @pre not empty.
Nees NeesOver(const std::vector<double>& values, const ChiSquareBand& band);

}  // namespace eval
