#include "eval/check/check_trajectory.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "eval/check/checked_text.h"
#include "io/number_text.h"

namespace eval {
namespace {

// Four decimals, as TUM prints them, are off by up to 5e-5 each: the norm by at most 1e-4.
constexpr double kUnitQuaternion = 1e-3;

}  // namespace

std::vector<CheckedPose> CheckTrajectory(FolderCheck& check, const std::string& file) {
  std::vector<CheckedPose> poses;
  StampOrder order(check, file);
  for (const CheckedLine& line : RecordsToCheck(check, file)) {
    std::array<double, 8> v{};
    bool numbers = line.words.size() == v.size();
    for (std::size_t i = 0; numbers && i < v.size(); ++i) {
      const auto value = io::ParseNumber(line.words[i]);
      numbers = value.has_value();
      v[i] = value.value_or(0);
    }
    if (!numbers) {
      check.Add(
          file, line.number,
          "expected `t tx ty tz qx qy qz qw`, eight finite numbers, found `" + line.text + "`",
          "write the pose of the camera in the world, or drop the line");
      continue;
    }
    order.Next(v[0], line.number);
    const Eigen::Quaterniond q(v[7], v[4], v[5], v[6]);
    if (!(std::abs(q.norm() - 1) <= kUnitQuaternion)) {
      check.Add(file, line.number,
                fmt::format("the quaternion has length {:.6f}; expected 1", q.norm()),
                "normalise qx qy qz qw (in this order)");
      continue;
    }
    CheckedPose pose{v[0], Eigen::Isometry3d::Identity(), line.number};
    pose.T_wc.linear() = q.normalized().toRotationMatrix();
    pose.T_wc.translation() = Eigen::Vector3d(v[1], v[2], v[3]);
    poses.push_back(pose);
  }
  order.Finish();
  return poses;
}

}  // namespace eval
