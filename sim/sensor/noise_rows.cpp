#include "sim/sensor/noise.h"
#include "sim/trace/lanes.h"

namespace sim {

SIM_LANES void PixelNoise::FillBits(std::uint64_t key, int u0, int v, std::uint64_t draw,
                                    std::uint64_t* bits, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    bits[i] = BitsOf(key, u0 + static_cast<int>(i), v, draw);
  }
}

}  // namespace sim
