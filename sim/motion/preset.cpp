#include "sim/motion/preset.h"

#include "sim/scene/input_error.h"

namespace sim {

MotionPreset PresetOf(const std::string& name) {
  if (name == "slow") return {0.20, 12, 5, 4.0, 0.6, 0.20, 0.02};
  if (name == "office") return {0.25, 13, 5, 4.0, 0.6, 0.20, 0.02};
  if (name == "fast") return {0.45, 34, 12, 9.0, 1.0, 0.50, 0.05};
  throw InputError("motion.preset '" + name + "'", "expected one of: slow, office, fast");
}

}  // namespace sim
