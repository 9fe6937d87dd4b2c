#pragma once

#include <cstdint>
#include <initializer_list>

namespace sim {

/// The fraction of the golden ratio, in 64 bits: its multiples spread evenly.
inline constexpr std::uint64_t kGoldenRatio = 0x9E3779B97F4A7C15ull;

/// SplitMix64's finaliser (Steele, Lea, Flood 2014).
inline std::uint64_t MixBits(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return z ^ (z >> 31);
}

/// Counter-based random numbers: draw i of a key depends on (key, i) alone, so results depend
/// neither on the order of work nor on the number of threads. No libm, no std:: distribution.
/// Draw at most once among the arguments of a call: their order is the compiler's choice.
class Random {
 public:
  /// The key names the stream: seed, family, object ...
  explicit Random(std::initializer_list<std::uint64_t> key) {
    for (const std::uint64_t part : key) state_ = MixBits(state_ ^ MixBits(part));
  }
  std::uint64_t Bits() { return MixBits(state_ + kGoldenRatio * ++counter_); }
  /// In [0, 1), 53 bits.
  double Uniform() { return static_cast<double>(Bits() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  double Between(double low, double high) { return low + (high - low) * Uniform(); }
  /// In {0, ..., n - 1}; n > 0.
  int Below(int n) {
    return static_cast<int>(((Bits() >> 32) * static_cast<std::uint64_t>(n)) >> 32);
  }
  bool Chance(double probability) { return Uniform() < probability; }

 private:
  std::uint64_t state_ = kGoldenRatio;
  std::uint64_t counter_ = 0;
};

}  // namespace sim
