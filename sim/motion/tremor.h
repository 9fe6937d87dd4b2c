#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/motion/preset.h"

namespace sim {

/// What the hand adds: a sum of sines in two bands, amplitudes falling as 1 / frequency when it
/// turns and as 1 / frequency^4 when it moves, as in recordings: of the power of the velocity
/// less than 1 % is above 2 Hz, of that of the turn rate a third. A smooth function of time
/// alone, with a bound.
class Tremor {
 public:
  Tremor(const MotionPreset& preset, std::uint64_t seed);
  Eigen::Vector3d Offset_m(double time_s) const;
  Eigen::Vector3d Turn_rad(double time_s) const;  ///< rotation vector, camera frame
  double MaxOffset_m() const { return max_offset_m_; }
  double MaxTurn_rad() const { return max_turn_rad_; }

 private:
  struct Wave {
    double frequency_hz, phase_turns;
    Eigen::Vector3d amplitude;
  };
  static Eigen::Vector3d Sum(const std::vector<Wave>& waves, double time_s);
  std::vector<Wave> offset_m_, turn_rad_;
  double max_offset_m_ = 0, max_turn_rad_ = 0;
};

}  // namespace sim
