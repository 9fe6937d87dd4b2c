#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "sim/base/pose.h"
#include "sim/base/random.h"
#include "sim/motion/free_space.h"
#include "sim/motion/preset.h"
#include "sim/motion/tremor.h"
#include "sim/motion/view.h"
#include "sim/scene/scene.h"

namespace sim {

/// An endless handheld path made knot by knot: uniform cubic B-splines of camera, gaze and roll
/// (C2), tremor on top. A knot depends on the earlier ones only.
///
/// Every knot leaves a safe way on: were all later knots equal to it, the path would still keep
/// its distance and pitch. So when no other knot will do, the camera can wait.
class CameraPath {
 public:
  /// @throws InputError when there is no place for the camera within scene.motion.
  CameraPath(const Scene& scene, std::uint64_t seed);
  /// Pose at a time from 0 on; adds the knots it needs.
  Pose At(double time_s);

 private:
  using Segment = std::array<View, 4>;
  View Smooth(double path_time_s) const;
  Pose Shaken(double path_time_s) const;
  void FindStart();
  void AddKnot();
  void Measure();
  std::vector<View> Candidates(double step_m, double turn_deg, Random& random) const;
  /// A knot that goes on from the last one; `swerve` 0 goes straight, 3 anywhere. May turn by
  /// about `turn_deg`.
  View Nearby(double step_m, double turn_deg, double swerve, Random& random) const;
  /// Moved onto the limits that have no width, which no draw would meet.
  View Held(View view) const;
  /// Comes near and goes away again in about half a minute.
  double WantedDistance_m() const;
  bool KnotFits(const View& view) const;
  bool SegmentIsSafe(const Segment& segment) const;
  bool IsSafe(const View& next) const;

  Motion motion_;
  MotionPreset preset_;
  FreeSpace space_;
  Tremor tremor_;
  std::uint64_t seed_;
  std::vector<View> knots_;
  // What the path has done since it began, sampled at 30 Hz, against what the preset asks.
  int measured_samples_ = 0;
  double length_behind_m_ = 0, turn_behind_deg_ = 0;
};

}  // namespace sim
