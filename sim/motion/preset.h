#pragma once

#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// Time between the poses of which a preset's mean speeds are taken.
inline constexpr double kPresetSample_s = 1.0 / 30;

/// How a hand moves a camera: means at 30 Hz of recorded sequences (TUM RGB-D: fr2/desk,
/// fr3/long_office_household, fr1/desk), and the tremor on top of the intended motion.
struct MotionPreset {
  double speed_m_s;
  double turn_deg_s;
  double max_roll_deg;  ///< about the optical axis, either way; 0: a pattern has its own
  double knot_s;  ///< between two knots of the path: hands have nearly no power above 1 Hz
  double slow_tremor_mm, fast_tremor_mm;    ///< standard deviation in space, 1-4 Hz and 4-12 Hz
  double slow_tremor_deg, fast_tremor_deg;  ///< the same of the rotation vector
};

/// @throws InputError when there is no such preset.
MotionPreset PresetOf(const std::string& name);

/// The same with the scene's own speeds, where it has them; a slower hand trembles less.
MotionPreset PresetOf(const Motion& motion);

}  // namespace sim
