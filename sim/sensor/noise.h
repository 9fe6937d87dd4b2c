#pragma once

#include <cstdint>

namespace sim {

/// Random numbers of an image, counter-based: each depends on (seed, frame, pixel, draw) alone,
/// so neither the order of pixels and frames nor the number of threads can change one.
class PixelNoise {
 public:
  PixelNoise(std::uint64_t seed, std::uint64_t frame);

  /// Uniform in (0, 1). `u`, `v` may lie outside the image.
  double Uniform(int u, int v, std::uint32_t draw) const;
  /// Standard normal.
  double Normal(int u, int v, std::uint32_t draw) const;

 private:
  std::uint64_t key_;
};

/// Quantile of the standard normal, p in (0, 1); Acklam's rational approximation (relative
/// error below 1.2e-9) with a logarithm of our own: no libm, so the same bits with every C
/// library.
double NormalQuantile(double p);

/// Distribution function of the standard normal (Abramowitz and Stegun 26.2.17, error < 1e-7).
double NormalProbability(double x);

}  // namespace sim
