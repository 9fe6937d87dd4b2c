#pragma once

#include <cstdint>
#include <span>

#include "sim/base/random.h"

namespace sim {

/// Random numbers of an image, counter-based: each depends on (seed, frame, pixel, draw) alone,
/// so neither the order of pixels and frames nor the number of threads can change one.
class PixelNoise {
 public:
  PixelNoise(std::uint64_t seed, std::uint64_t frame);

  /// Uniform in (0, 1). `u`, `v` may lie outside the image.
  double Uniform(int u, int v, std::uint32_t draw) const;
  /// Standard normal: one of 65,536 quantiles, to 4.3 sd. Four draws (4 k to 4 k + 3) come
  /// from one set of bits.
  double Normal(int u, int v, std::uint32_t draw) const {
    return static_cast<double>(NormalOf(NormalBits(u, v, draw), draw));
  }
  /// The bits of the normals of draws 4 k to 4 k + 3; NormalOf takes one of them out.
  std::uint64_t NormalBits(int u, int v, std::uint32_t draw) const {
    return BitsOf(key_, u, v, kNormals + draw / 4);
  }
  /// Those bits of the pixels (u0, v), (u0 + 1, v) and so on.
  void NormalBitsOfRow(int u0, int v, std::uint32_t draw, std::span<std::uint64_t> bits) const {
    FillBits(key_, u0, v, kNormals + draw / 4, bits.data(), bits.size());
  }
  static float NormalOf(std::uint64_t bits, std::uint32_t draw) {
    return NormalTable()[bits >> (16 * (draw % 4)) & 0xFFFFu];
  }
  /// The same of many: every `step`th of the normals is filled.
  static void NormalsOf(std::span<const std::uint64_t> bits, std::uint32_t draw,
                        std::size_t step, float* normals);
  /// Quantiles at (i + 1/2) / 65,536.
  static const float* NormalTable();

 private:
  /// Keys of their own for normals, apart from those of Uniform.
  static constexpr std::uint64_t kNormals = 1ull << 32;

  static std::uint64_t BitsOf(std::uint64_t key, int u, int v, std::uint64_t draw) {
    const std::uint64_t place =
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)) << 32) |
        static_cast<std::uint32_t>(u);
    return MixBits(MixBits(key + place * kGoldenRatio) + draw * 0xD1B54A32D192ED03ull);
  }
  static void FillBits(std::uint64_t key, int u0, int v, std::uint64_t draw,
                       std::uint64_t* bits, std::size_t count);

  std::uint64_t key_;
};

/// Quantile of the standard normal, p in (0, 1); Acklam's rational approximation (relative
/// error below 1.2e-9) with a logarithm of our own: no libm, so the same bits with every C
/// library.
double NormalQuantile(double p);

/// The next draw of the stream, standard normal.
inline double NormalDraw(Random& random) {
  return NormalQuantile((static_cast<double>(random.Bits() >> 11) + 0.5) * 0x1.0p-53);
}

/// Distribution function of the standard normal (Abramowitz and Stegun 26.2.17, error < 1e-7).
double NormalProbability(double x);

}  // namespace sim
