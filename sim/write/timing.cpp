#include "sim/write/timing.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "sim/sensor/noise.h"

namespace sim {
namespace {

/// Keeps these draws apart from the noise of frames.
constexpr std::uint64_t kTimingFrame = 0xFFFFFFFFFFFFFFFEull;
enum Draw : std::uint32_t { kDrop = 0, kJitter = 1, kRepeat = 2 };

/// The smaller gap to a neighbour, seconds; that of the path's begin where there is only one.
double Gap(const std::vector<TimedPose>& path, std::size_t i) {
  double gap = 1e9;
  if (i > 0) gap = std::min(gap, path[i].timestamp_s - path[i - 1].timestamp_s);
  if (i + 1 < path.size()) gap = std::min(gap, path[i + 1].timestamp_s - path[i].timestamp_s);
  return gap;
}

}  // namespace

std::vector<Shot> MakeShots(const std::vector<TimedPose>& trajectory,
                            const TimingDefects& defects, std::uint64_t seed) {
  const PixelNoise noise(seed, kTimingFrame);
  std::vector<Shot> shots;
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    const int place = static_cast<int>(i);
    if (i > 0 && defects.drop_ratio > 0 &&
        noise.Uniform(place, 0, kDrop) < defects.drop_ratio) {
      continue;
    }
    Shot shot;
    shot.time_s = shot.colour_stamp_s = trajectory[i].timestamp_s;
    if (defects.stamp_jitter_s > 0) {
      const double most = 0.45 * Gap(trajectory, i);
      shot.colour_stamp_s += std::clamp(
          defects.stamp_jitter_s * noise.Normal(place, 0, kJitter), i > 0 ? -most : 0.0, most);
    }
    shot.depth_stamp_s = shot.colour_stamp_s + defects.depth_offset_s;
    shot.T_wc = trajectory[i].T_wc;
    shot.exposed = static_cast<int>(shots.size());
    if (i > 0 && defects.repeat_ratio > 0 &&
        noise.Uniform(place, 0, kRepeat) < defects.repeat_ratio) {
      shot.exposed = shots.back().exposed;
      shot.T_wc = shots.back().T_wc;
    }
    shots.push_back(shot);
  }
  return shots;
}

Pose PoseAt(const std::vector<TimedPose>& path, double time_s) {
  if (path.size() < 2) return path.front().T_wc;
  const auto later =
      std::upper_bound(path.begin() + 1, path.end() - 1, time_s,
                       [](double t, const TimedPose& pose) { return t < pose.timestamp_s; });
  const TimedPose& b = *later;
  const TimedPose& a = *(later - 1);
  const double share = (time_s - a.timestamp_s) / (b.timestamp_s - a.timestamp_s);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(a.T_wc.R.transpose() * b.T_wc.R));
  Pose T_wc;
  T_wc.R = a.T_wc.R * Eigen::AngleAxisd(share * turn.angle(), turn.axis()).toRotationMatrix();
  T_wc.t = a.T_wc.t + share * (b.T_wc.t - a.T_wc.t);
  return T_wc;
}

}  // namespace sim
