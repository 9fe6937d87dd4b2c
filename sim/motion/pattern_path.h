#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "sim/motion/free_space.h"
#include "sim/motion/pattern.h"
#include "sim/motion/preset.h"
#include "sim/motion/tremor.h"

namespace sim {

/// An endless path along a pattern (xyz, rpy, 360, orbit, loop, lookaway), paced so that the
/// mean speed and turn at 30 Hz are the preset's: cubic B-splines through views of the pattern,
/// tremor on top. Every part of the way keeps 15 cm from every object, slower where it must.
class PatternPath {
 public:
  static bool Has(const std::string& preset);
  /// @throws InputError when no way of that kind is free within scene.motion.
  PatternPath(const Scene& scene, std::uint64_t seed);
  /// Pose at a time from 0 on; adds the knots it needs.
  Pose At(double time_s);

 private:
  void FindWay(const Scene& scene);
  bool IsFree(const Pattern& pattern) const;
  void AddKnot();
  double PlaceAfter(const View& last, double step_m) const;
  bool KeepsClear(const View& next) const;
  void Measure();
  Pose Shaken(double time_s) const;

  MotionPreset preset_;
  FreeSpace space_;
  Tremor tremor_;
  std::uint64_t seed_;
  std::shared_ptr<const Pattern> pattern_;
  double round_m_ = 1;  ///< length of the way
  double place_ = 0, look_ = 0;
  std::vector<View> knots_;
  int measured_samples_ = 0;
  double length_behind_m_ = 0, turn_behind_deg_ = 0;
};

}  // namespace sim
