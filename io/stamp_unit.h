#pragma once

#include <optional>
#include <vector>

namespace io {

/// Seconds since 1970 reach it in the year 5138; milliseconds passed it in 1973.
inline constexpr double kMaxStamp_s = 1e11;

/// Median time from one stamp to the next, in whatever order they are given; nothing for less than
/// three stamps, of which one may be wrong.
std::optional<double> MedianStep(std::vector<double> stamps_s);

/// Whether the stamps of a recording can be seconds, and not a smaller unit or one since the
/// machine was started.
bool CanBeSeconds(const std::vector<double>& stamps_s);

}  // namespace io
