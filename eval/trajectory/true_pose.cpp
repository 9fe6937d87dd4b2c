#include "eval/trajectory/true_pose.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "eval/formats/stamps.h"

namespace eval {

std::optional<Pose> PoseAt(const Trajectory& poses, double stamp_s) {
  const auto after = std::lower_bound(
      poses.begin(), poses.end(), stamp_s,
      [](const StampedPose& pose, double stamp) { return pose.stamp_s < stamp; });

  // A pose of the same stamp is taken as it stands, so that exact truth stays exact.
  for (auto near = after == poses.begin() ? after : after - 1; near != poses.end(); ++near) {
    if (std::abs(near->stamp_s - stamp_s) <= kSameStamp_s) return near->T_wc;
    if (near == after) break;
  }
  if (after == poses.begin() || after == poses.end()) return std::nullopt;

  const StampedPose& a = *(after - 1);
  const StampedPose& b = *after;
  const double gap_s = b.stamp_s - a.stamp_s;
  if (!(gap_s <= kMaxPoseGap_s)) return std::nullopt;
  const double share = (stamp_s - a.stamp_s) / gap_s;
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(a.T_wc.R).slerp(share, Eigen::Quaterniond(b.T_wc.R));
  return Pose{q.toRotationMatrix(), (1 - share) * a.T_wc.t + share * b.T_wc.t};
}

}  // namespace eval
