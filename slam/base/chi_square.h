#pragma once

namespace slam {

/// Bounds that a chi-square passes with a probability of 5 %, by degrees of freedom.
inline constexpr double kChi2Of1At95 = 3.841;
inline constexpr double kChi2Of2At95 = 5.991;
inline constexpr double kChi2Of3At95 = 7.815;

}  // namespace slam
