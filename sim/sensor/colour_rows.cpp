#include "sim/sensor/colour_rows.h"

#include <algorithm>
#include <cmath>

#include "sim/trace/lanes.h"

namespace sim {

SIM_LANES void KeptLight(double mid_u, double mid_v, double loss, int v, int width,
                         int channels, float* kept) {
  for (int u = 0; u < width; ++u) {
    const double r2 = (u - mid_u) * (u - mid_u) + (v - mid_v) * (v - mid_v);
    const auto share = static_cast<float>(1.0 - loss * r2);
    for (int k = 0; k < channels; ++k) kept[channels * u + k] = share;
  }
}

SIM_LANES void LightCodes(const float* light, const float* kept, const float* normal,
                          const LightVariance& variance, int steps, int count,
                          std::int32_t* codes) {
  const float shot = variance.shot, read = variance.read, whole = static_cast<float>(steps);
  for (int i = 0; i < count; ++i) {
    const float mean = kept[i] * light[i];
    const float lit = mean > 0.0F ? mean : 0.0F;
    const float sigma = std::sqrt(shot * lit + read);
    const float drawn = mean + sigma * normal[i];
    const float above = drawn > 0.0F ? drawn : 0.0F;
    const float inside = above < 1.0F ? above : 1.0F;
    codes[i] = static_cast<std::int32_t>(inside * whole + 0.5F);
  }
}

}  // namespace sim
