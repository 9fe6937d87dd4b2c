#pragma once

#include <cstdint>

namespace sim {

/// Random numbers that change slowly over frames, so that a detector fails in runs: standard
/// normal at every frame, correlated over about `run_frames`. Frame f depends on (key, f)
/// alone, never on the frames before it.
class SlowNoise {
 public:
  SlowNoise(std::uint64_t key, int run_frames) : key_(key), run_frames_(run_frames) {}
  double Normal(int frame) const;
  /// Uniform in (0, 1), as slow.
  double Uniform(int frame) const;

 private:
  std::uint64_t key_;
  int run_frames_;
};

}  // namespace sim
