#pragma once

#include <cstdint>
#include <vector>

#include "sim/motion/trajectory.h"
#include "sim/sensor/timing_defects.h"

namespace sim {

/// One frame. The colour stamp names it in all lists; truth is of its exposure.
struct Shot {
  double time_s = 0;          ///< middle of the colour exposure
  double colour_stamp_s = 0;  ///< as recorded
  double depth_stamp_s = 0;   ///< as recorded
  Pose T_wc;                  ///< at time_s; of a repeated frame, at the time that it repeats
  /// The shot whose images this one shows, as a place in the list of shots; its own place
  /// unless the frame is repeated.
  int exposed = 0;
  /// Depth is exposed this much after colour.
  double DepthDelay_s() const { return depth_stamp_s - colour_stamp_s; }
};

/// The shots of a trajectory. Each hangs on the seed and its own place in the trajectory, so
/// that a longer recording begins with the shots of a shorter one. Jitter is held below 0.45 of
/// the gap to the neighbours, so that stamps keep their order.
std::vector<Shot> MakeShots(const std::vector<TimedPose>& trajectory,
                            const TimingDefects& defects, std::uint64_t seed);

/// Pose at any time: between two poses a straight way and a steady turn, and so on at the ends.
/// @pre path not empty, times grow
Pose PoseAt(const std::vector<TimedPose>& path, double time_s);

}  // namespace sim
