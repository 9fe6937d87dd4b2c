#pragma once

namespace slam {

/// Bounds that a chi-square passes with a probability of 5 %, by degrees of freedom.
inline constexpr double kChi2Of1At95 = 3.841;
inline constexpr double kChi2Of2At95 = 5.991;
inline constexpr double kChi2Of3At95 = 7.815;

/// The same for a probability of 0.1 % (13.82 and 16.27, rounded up): bounds on what must rarely
/// be refused.
inline constexpr double kChi2Of2At999 = 13.9;
inline constexpr double kChi2Of3At999 = 16.3;

}  // namespace slam
