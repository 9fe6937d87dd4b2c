#pragma once

#include <cstdint>

// The colour camera by rows. Same bits on every processor.
namespace sim {

/// Share of the light that vignetting leaves of row v's pixels, each `channels` times.
void KeptLight(double mid_u, double mid_v, double loss, int v, int width, int channels,
               float* kept);

/// Variance of linear light: shot * light + read.
struct LightVariance {
  float shot = 0, read = 0;
};

/// Light in [0, 1] by whole steps, of `count` samples.
/// @param normal  standard normal
void LightCodes(const float* light, const float* kept, const float* normal,
                const LightVariance& variance, int steps, int count, std::int32_t* codes);

}  // namespace sim
