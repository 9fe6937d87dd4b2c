#include "sim/motion/pace.h"

#include "sim/base/random.h"

namespace sim {

double PaceAt(std::uint64_t seed, std::size_t knot, std::size_t knots_between_draws,
              double spread) {
  const auto drawn = [&](std::size_t i) {
    return Random({0x70616365, seed, i}).Between(1 - spread, 1 + spread);
  };
  const std::size_t i = knot / knots_between_draws;
  const double u = static_cast<double>(knot % knots_between_draws) /
                   static_cast<double>(knots_between_draws);
  const double weight = u * u * (3 - 2 * u);
  return drawn(i) * (1 - weight) + drawn(i + 1) * weight;
}

}  // namespace sim
