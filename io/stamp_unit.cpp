#include "io/stamp_unit.h"

#include <algorithm>
#include <cstddef>

namespace io {
namespace {

// Nobody records a frame every quarter of an hour; a 1 Hz recording in milliseconds has this
// step.
constexpr double kMaxMedianStep_s = 900;

}  // namespace

std::optional<double> MedianStep(std::vector<double> stamps_s) {
  std::sort(stamps_s.begin(), stamps_s.end());
  std::vector<double> steps_s;
  for (std::size_t i = 1; i < stamps_s.size(); ++i) {
    steps_s.push_back(stamps_s[i] - stamps_s[i - 1]);
  }
  if (steps_s.size() < 2) return std::nullopt;
  const auto middle = steps_s.begin() + static_cast<std::ptrdiff_t>(steps_s.size() / 2);
  std::nth_element(steps_s.begin(), middle, steps_s.end());
  return *middle;
}

bool CanBeSeconds(const std::vector<double>& stamps_s) {
  const auto too_large = [](double t_s) { return t_s > kMaxStamp_s; };
  return std::none_of(stamps_s.begin(), stamps_s.end(), too_large) &&
         MedianStep(stamps_s).value_or(0.0) <= kMaxMedianStep_s;
}

}  // namespace io
