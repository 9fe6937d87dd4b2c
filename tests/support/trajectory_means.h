#pragma once

#include <vector>

#include "sim/motion/trajectory.h"
#include "sim/scene/angle.h"

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

}  // namespace sim
