#include "sim/motion/preset.h"

#include <algorithm>

#include "io/input_error.h"
#include "sim/scene/names.h"

namespace sim {

MotionPreset PresetOf(const std::string& name) {
  if (name == "slow") return {0.205, 12.8, 5, 0.5, 5.8, 0.25, 0.40, 0.06};
  if (name == "office") return {0.254, 14.1, 5, 0.5, 4.5, 0.25, 0.40, 0.06};
  if (name == "fast") return {0.453, 35.0, 22, 0.4, 13.0, 0.5, 0.80, 0.10};
  // Hardly any turning; hardly any way; both; and what follows a path (pattern_path.h).
  if (name == "xyz") return {0.304, 17.2, 0, 0.25, 2.0, 0.25, 0.50, 0.08};
  if (name == "rpy") return {0.06, 50, 0, 0.25, 1.5, 0.2, 0.60, 0.08};
  if (name == "360") return {0.21, 42, 0, 0.25, 3.0, 0.3, 0.60, 0.08};
  if (name == "orbit") return {0.25, 16, 0, 0.25, 2.5, 0.25, 0.40, 0.06};
  if (name == "loop") return {0.254, 14.1, 0, 0.25, 5.0, 0.25, 0.30, 0.06};
  if (name == "lookaway") return {0.20, 25, 0, 0.25, 2.5, 0.25, 0.40, 0.06};
  std::string known;
  for (const std::string& one : kPresetNames) known += (known.empty() ? "" : ", ") + one;
  throw io::InputError("motion.preset '" + name + "'", "expected one of: " + known);
}

MotionPreset PresetOf(const Motion& motion) {
  MotionPreset preset = PresetOf(motion.preset);
  if (motion.speed_m_s > 0) {
    const double part = std::min(1.0, motion.speed_m_s / preset.speed_m_s);
    preset.slow_tremor_mm *= part;
    preset.fast_tremor_mm *= part;
    preset.speed_m_s = motion.speed_m_s;
  }
  if (motion.turn_deg_s > 0) {
    const double part = std::min(1.0, motion.turn_deg_s / preset.turn_deg_s);
    preset.slow_tremor_deg *= part;
    preset.fast_tremor_deg *= part;
    preset.turn_deg_s = motion.turn_deg_s;
  }
  return preset;
}

}  // namespace sim
