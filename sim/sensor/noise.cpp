#include "sim/sensor/noise.h"

#include <bit>
#include <cmath>
#include <vector>

namespace sim {
namespace {

constexpr double kLn2 = 0.693147180559945309417;

/// ln x, x normal and positive: exponent and the series of atanh, IEEE operations only.
double Log(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  int exponent = static_cast<int>(bits >> 52) - 1023;
  double m = std::bit_cast<double>((bits & 0x000FFFFFFFFFFFFFull) | 0x3FF0000000000000ull);
  if (m > 1.4142135623730951) {
    m *= 0.5;
    ++exponent;
  }
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s;  // |s| < 0.172
  double sum = 0;
  for (int k = 17; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  return exponent * kLn2 + 2.0 * s * sum;
}

/// exp(-x), 0 <= x < 700: halved ten times, series, squared back.
double ExpMinus(double x) {
  const double t = -x / 1024.0;
  double e = 1.0 + t * (1.0 + t / 2.0 * (1.0 + t / 3.0 * (1.0 + t / 4.0 * (1.0 + t / 5.0))));
  for (int i = 0; i < 10; ++i) e *= e;
  return e;
}

double LowerTail(double p) {
  const double q = std::sqrt(-2.0 * Log(p));
  return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838e+00) *
                q -
            2.549732539343734e+00) *
               q +
           4.374664141464968e+00) *
              q +
          2.938163982698783e+00) /
         ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996e+00) *
               q +
           3.754408661907416e+00) *
              q +
          1.0);
}

}  // namespace

double NormalQuantile(double p) {
  constexpr double kTail = 0.02425;
  if (p < kTail) return LowerTail(p);
  if (p > 1.0 - kTail) return -LowerTail(1.0 - p);
  const double q = p - 0.5, r = q * q;
  return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) *
                r +
            1.383577518672690e+02) *
               r -
           3.066479806614716e+01) *
              r +
          2.506628277459239e+00) *
         q /
         (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) *
                r +
            6.680131188771972e+01) *
               r -
           1.328068155288572e+01) *
              r +
          1.0);
}

double NormalProbability(double x) {
  const double a = std::abs(x);
  const double t = 1.0 / (1.0 + 0.2316419 * a);
  const double poly =
      t * (0.319381530 +
           t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
  const double tail = a > 37.0 ? 0.0 : 0.3989422804014327 * ExpMinus(0.5 * a * a) * poly;
  return x >= 0 ? 1.0 - tail : tail;
}

PixelNoise::PixelNoise(std::uint64_t seed, std::uint64_t frame)
    : key_(MixBits(MixBits(seed + kGoldenRatio) ^ MixBits(frame + 0x51ED270B1A2F39C5ull))) {}

double PixelNoise::Uniform(int u, int v, std::uint32_t draw) const {
  return (static_cast<double>(BitsOf(key_, u, v, draw) >> 11) + 0.5) * 0x1.0p-53;
}

const float* PixelNoise::NormalTable() {
  static const std::vector<float> table = [] {
    constexpr std::size_t kSize = 65536;
    std::vector<float> quantiles(kSize);
    for (std::size_t i = 0; i < kSize; ++i) {
      quantiles[i] = static_cast<float>(NormalQuantile((static_cast<double>(i) + 0.5) / kSize));
    }
    return quantiles;
  }();
  return table.data();
}

void PixelNoise::NormalsOf(std::span<const std::uint64_t> bits, std::uint32_t draw,
                           std::size_t step, float* normals) {
  const float* const table = NormalTable();
  const std::uint32_t shift = 16 * (draw % 4);
  for (const std::uint64_t four : bits) {
    *normals = table[four >> shift & 0xFFFFu];
    normals += step;
  }
}

}  // namespace sim
