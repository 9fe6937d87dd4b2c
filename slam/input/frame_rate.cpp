#include "slam/input/frame_rate.h"

#include <cmath>
#include <optional>

#include "io/number_text.h"
#include "io/stamp_unit.h"

namespace slam {
namespace {

// A camera of 30 frames a second may record 10 of them, in the dark or to spare its bus; the
// smallest error of a unit, frame numbers for seconds, is the number of frames a second.
constexpr double kMaxRateRatio = 4;

/// Six digits at most.
std::string Short(double number) {
  const double scale = std::pow(10.0, 5 - std::floor(std::log10(number)));
  return io::NumberText(std::round(number * scale) / scale);
}

/// What steps so long would be at that rate.
const char* UnitOf(double step, double steps_a_frame) {
  constexpr double kRoundOff = 1e-6;
  constexpr double kOfMilliseconds = 1e3 / kMaxRateRatio, kOfMicroseconds = 1e6 / kMaxRateRatio;
  if (std::abs(step - 1) < kRoundOff) return "; they look like numbers of frames";
  if (steps_a_frame > kOfMicroseconds) return "; they look like microseconds";
  if (steps_a_frame > kOfMilliseconds) return "; they look like milliseconds";
  return "";
}

}  // namespace

std::string RateWarning(const std::vector<SequenceEntry>& entries, double fps) {
  std::vector<double> stamps_s;
  for (const SequenceEntry& entry : entries) stamps_s.push_back(entry.timestamp_s);
  const std::optional<double> step_s = io::MedianStep(stamps_s);
  if (!step_s) return "";
  const double ratio = *step_s * fps;
  if (ratio <= kMaxRateRatio && ratio >= 1 / kMaxRateRatio) return "";
  return "a colour image comes every " + Short(*step_s) +
         " s (median), but fps of the camera is " + Short(fps) +
         ": are the timestamps seconds" + UnitOf(*step_s, ratio) +
         "? if they are, set fps to " + Short(1 / *step_s);
}

}  // namespace slam
