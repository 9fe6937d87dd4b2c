#pragma once

#include <algorithm>
#include <vector>

#include "sim/base/angle.h"
#include "sim/motion/trajectory.h"

namespace sim {

/// Mean speeds of a trajectory.
struct Means {
  double speed_m_s = 0, turn_deg_s = 0;
};

inline Means MeansOf(const std::vector<TimedPose>& trajectory) {
  Means means;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    const Pose &a = trajectory[i - 1].T_wc, &b = trajectory[i].T_wc;
    means.speed_m_s += (b.t - a.t).norm();
    means.turn_deg_s += RadToDeg(Eigen::AngleAxisd(a.R.transpose() * b.R).angle());
  }
  const double time_s = trajectory.back().timestamp_s;
  return {means.speed_m_s / time_s, means.turn_deg_s / time_s};
}

/// Largest change of the velocity from one step to the next, in four seconds of the motion at
/// `fps`, seed 1. A jump of the velocity would not shrink with the interval; a smooth change
/// does, in proportion.
inline double LargestChange(const Scene& scene, double fps) {
  const auto trajectory = MakeTrajectory(scene, static_cast<int>(4 * fps), fps, 1);
  double largest = 0;
  for (std::size_t i = 2; i < trajectory.size(); ++i) {
    const Pose &a = trajectory[i - 2].T_wc, &b = trajectory[i - 1].T_wc,
               &c = trajectory[i].T_wc;
    largest = std::max(
        {largest, (c.t - 2 * b.t + a.t).norm() * fps, (c.R - 2 * b.R + a.R).norm() * fps});
  }
  return largest;
}

}  // namespace sim
