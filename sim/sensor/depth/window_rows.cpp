#include "sim/sensor/depth/window_rows.h"

#include <cmath>
#include <cstring>

#include "sim/trace/lanes.h"

namespace sim {
namespace {

using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));

template <typename Eight, typename Number>
[[gnu::always_inline]] inline Eight LoadEight(const Number* numbers) {
  Eight eight;
  std::memcpy(&eight, numbers, sizeof eight);
  return eight;
}

}  // namespace

SIM_LANES WindowCounts CountWindows(const MatchView& view, int u, int v, int reach) {
  const std::ptrdiff_t middle = v * view.stride + u;
  const auto own = LoadEight<EightFloats>(view.steps + middle);
  const auto own_surface = LoadEight<EightInts>(view.surface + middle);
  const float most = view.max_apart_steps;
  const EightFloats limit = own + most;
  EightInts same{}, nearer{};
  for (int dv = -reach; dv <= reach; ++dv) {
    for (int du = -reach; du <= reach; ++du) {
      const std::ptrdiff_t at = middle + dv * view.stride + du;
      const auto steps = LoadEight<EightFloats>(view.steps + at);
      const auto surface = LoadEight<EightInts>(view.surface + at);
      const EightFloats apart = steps - own;
      // What holds is -1.
      same -=
          (steps > 0.0F) & ((surface == own_surface) | ((apart <= most) & (apart >= -most)));
      nearer -= steps > limit;
    }
  }
  WindowCounts counts;
  std::memcpy(counts.same.data(), &same, sizeof same);
  std::memcpy(counts.nearer.data(), &nearer, sizeof nearer);
  return counts;
}

SIM_LANES void MarkApart(const MatchView& view, std::ptrdiff_t from, std::ptrdiff_t to,
                         int count, std::uint8_t* __restrict marks) {
  const float *a = view.steps + from, *b = view.steps + to;
  const std::int32_t *on = view.surface + from, *other = view.surface + to;
  const float most = view.max_apart_steps;
  for (int i = 0; i < count; ++i) {
    const bool one_shown = (a[i] > 0.0F) != (b[i] > 0.0F);
    const bool match = (on[i] == other[i]) | (std::abs(a[i] - b[i]) <= most);
    marks[i] = (one_shown | !match) ? 255 : marks[i];
  }
}

SIM_LANES void DisparitySteps(const double* z_m, const std::uint8_t* lit, double steps_m,
                              int count, float* __restrict steps) {
  for (int i = 0; i < count; ++i) {
    steps[i] = z_m[i] > 0 ? static_cast<float>(steps_m / z_m[i]) : 0.0F;
  }
  for (int i = 0; lit != nullptr && i < count; ++i) steps[i] = lit[i] != 0 ? steps[i] : 0.0F;
}

}  // namespace sim
