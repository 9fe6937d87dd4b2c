#include "sim/motion/preset.h"

#include <gtest/gtest.h>

#include "sim/scene/names.h"

namespace sim {
namespace {

TEST(MotionPreset, TremblesLessInBothBandsWithASlowerHandAndNoMoreWithAFasterOne) {
  for (const std::string& name : kPresetNames) {
    const MotionPreset usual = PresetOf(name);
    Motion motion;
    motion.preset = name;
    for (const double part : {0.25, 0.7}) {
      motion.speed_m_s = part * usual.speed_m_s;
      motion.turn_deg_s = part * usual.turn_deg_s;
      const MotionPreset slower = PresetOf(motion);
      EXPECT_LT(slower.slow_tremor_mm, 0.9 * usual.slow_tremor_mm) << name;
      EXPECT_LT(slower.fast_tremor_mm, 0.9 * usual.fast_tremor_mm) << name;
      EXPECT_LT(slower.slow_tremor_deg, 0.9 * usual.slow_tremor_deg) << name;
      EXPECT_LT(slower.fast_tremor_deg, 0.9 * usual.fast_tremor_deg) << name;
    }
    motion.speed_m_s = 2 * usual.speed_m_s;
    motion.turn_deg_s = 2 * usual.turn_deg_s;
    const MotionPreset faster = PresetOf(motion);
    EXPECT_EQ(faster.slow_tremor_mm, usual.slow_tremor_mm) << name;
    EXPECT_EQ(faster.fast_tremor_mm, usual.fast_tremor_mm) << name;
    EXPECT_EQ(faster.slow_tremor_deg, usual.slow_tremor_deg) << name;
    EXPECT_EQ(faster.fast_tremor_deg, usual.fast_tremor_deg) << name;
  }
}

}  // namespace
}  // namespace sim
