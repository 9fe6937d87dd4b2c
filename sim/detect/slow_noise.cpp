#include "sim/detect/slow_noise.h"

#include <cmath>

#include "sim/base/random.h"
#include "sim/sensor/noise.h"

namespace sim {

double SlowNoise::Normal(int frame) const {
  // Phase of its own, so that not all streams turn at the same frame.
  const int shifted = frame + Random({key_, 0x5A1ull}).Below(run_frames_);
  const int knot = shifted / run_frames_;
  const double t = static_cast<double>(shifted % run_frames_) / run_frames_;
  const auto at = [&](int k) {
    Random random{key_, 0xC0FFEEull, static_cast<std::uint64_t>(k)};
    return NormalDraw(random);
  };
  const double mixed = (1.0 - t) * at(knot) + t * at(knot + 1);
  return mixed / std::sqrt((1.0 - t) * (1.0 - t) + t * t);  // unit variance between knots too
}

double SlowNoise::Uniform(int frame) const { return NormalProbability(Normal(frame)); }

}  // namespace sim
