#pragma once

#include <cstddef>
#include <cstdint>

namespace sim {

inline constexpr std::size_t kKnotsPerBurst = 2;  ///< a burst of turning lasts so many knots

/// How fast a hand goes at a knot against its mean: between 1 - spread and 1 + spread, drawn
/// anew every so many knots and going over smoothly from one to the next, since a hand that
/// hurries goes on hurrying for some seconds.
double PaceAt(std::uint64_t seed, std::size_t knot, std::size_t knots_between_draws,
              double spread);

}  // namespace sim
