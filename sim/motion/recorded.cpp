#include "sim/motion/recorded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "io/input_error.h"
#include "io/number_text.h"
#include "io/text_table.h"

namespace sim {
namespace {

TimedPose PoseFrom(const io::TextRecord& record) {
  constexpr double kUnit = 0.02, kFar_m = 1000;
  std::array<double, 8> n{};
  for (std::size_t i = 0; i < n.size(); ++i) n[i] = record.Number(i, "a pose");
  const Eigen::Vector3d t(n[1], n[2], n[3]);
  if (!(t.cwiseAbs().maxCoeff() <= kFar_m)) {
    throw io::InputError(record.where, "expected metres, found a position more than 1 km away");
  }
  const Eigen::Quaterniond q(n[7], n[4], n[5], n[6]);
  if (!(std::abs(q.norm() - 1) < kUnit)) {
    throw io::InputError(record.where, "expected a unit quaternion, found one of norm " +
                                           io::NumberText(q.norm()));
  }
  return {n[0], {q.normalized().toRotationMatrix(), t}};
}

Pose Between(const Pose& a, const Pose& b, double part) {
  const Eigen::Quaterniond from(a.R);
  Eigen::Quaterniond to(b.R);
  if (from.dot(to) < 0) to.coeffs() *= -1;
  // Between poses a few degrees apart the chord is the arc, to a thousandth of the angle.
  const Eigen::Quaterniond mixed(
      Eigen::Vector4d((1 - part) * from.coeffs() + part * to.coeffs()).normalized());
  return {mixed.toRotationMatrix(), (1 - part) * a.t + part * b.t};
}

}  // namespace

std::vector<TimedPose> ReadTrajectory(const std::filesystem::path& path) {
  std::vector<TimedPose> poses;
  double first_s = 0;
  for (const io::TextRecord& record : io::ReadRecords(
           path, "timestamp tx ty tz qx qy qz qw", "expected a trajectory in the TUM form")) {
    TimedPose pose = PoseFrom(record);
    if (poses.empty()) first_s = pose.timestamp_s;
    pose.timestamp_s -= first_s;
    if (!poses.empty() && !(pose.timestamp_s > poses.back().timestamp_s)) {
      throw io::InputError(record.where,
                           "its timestamp is not after the one before; sort the lines");
    }
    poses.push_back(pose);
  }
  if (poses.size() < 2) throw io::InputError(path.string(), "expected two poses or more");
  return poses;
}

int FramesOf(const std::vector<TimedPose>& recorded, double fps) {
  constexpr double kRounding_s = 1e-6;  // of times that are written with six digits
  const double last = std::floor((recorded.back().timestamp_s + kRounding_s) * fps);
  return static_cast<int>(std::min(last, std::numeric_limits<int>::max() - 1.0)) + 1;
}

std::vector<TimedPose> Replay(const std::vector<TimedPose>& recorded, int frames, double fps,
                              const std::string& name) {
  constexpr double kHole_s = 0.5;
  if (!(frames >= 1)) throw std::invalid_argument("a trajectory has at least one frame");
  if (!(fps > 0 && std::isfinite(fps))) throw std::invalid_argument("fps must be positive");
  if (recorded.size() < 2) throw std::invalid_argument("a recording has two poses or more");
  const double end_s = recorded.back().timestamp_s;
  if (frames > FramesOf(recorded, fps)) {
    throw io::InputError(name, "is " + io::NumberText(end_s) + " s long; ask for at most " +
                                   std::to_string(FramesOf(recorded, fps)) + " frames");
  }
  std::vector<TimedPose> trajectory;
  std::size_t next = 1;
  for (int i = 0; i < frames; ++i) {
    const double time_s = i / fps;
    while (next + 1 < recorded.size() && recorded[next].timestamp_s < time_s) ++next;
    const TimedPose &a = recorded[next - 1], &b = recorded[next];
    const double gap_s = b.timestamp_s - a.timestamp_s;
    if (gap_s > kHole_s) {
      throw io::InputError(name, "has a hole of " + io::NumberText(gap_s) + " s after " +
                                     io::NumberText(a.timestamp_s) + " s; cut it there");
    }
    const double part = std::clamp((time_s - a.timestamp_s) / gap_s, 0.0, 1.0);
    trajectory.push_back({time_s, Between(a.T_wc, b.T_wc, part)});
  }
  return trajectory;
}

}  // namespace sim
