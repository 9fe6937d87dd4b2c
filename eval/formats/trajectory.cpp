#include "eval/formats/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"
#include "io/number_text.h"

namespace eval {
namespace {

// Four decimals, as TUM prints them, are off by up to 5e-5 each: the norm by at most 1e-4.
constexpr double kUnitQuaternion = 1e-3;

std::optional<std::array<double, 8>> ReadNumbers(const io::TextRecord& record) {
  std::array<double, 8> numbers{};
  if (record.fields.size() != numbers.size()) return std::nullopt;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = io::ParseNumber(record.fields[i]);
    if (!number) return std::nullopt;
    numbers[i] = *number;
  }
  return numbers;
}

/// Nothing when the line is at fault, which is told.
std::optional<StampedPose> ReadPose(Folder& folder, const std::string& file,
                                    const io::TextRecord& record) {
  const auto v = ReadNumbers(record);
  if (!v) {
    folder.Tell(
        file, record.line,
        "expected `t tx ty tz qx qy qz qw`, eight finite numbers, found " + TextOf(record),
        "write the pose of the camera in the world, or drop the line");
    return std::nullopt;
  }
  const auto& [stamp_s, tx, ty, tz, qx, qy, qz, qw] = *v;
  const Eigen::Vector3d t(tx, ty, tz);
  if (!(t.cwiseAbs().maxCoeff() <= kMaxCoordinate_m)) {
    folder.Tell(
        file, record.line,
        fmt::format("expected a position within {:g} m of the origin, found {:g} {:g} {:g}",
                    kMaxCoordinate_m, tx, ty, tz),
        "write metres, in a world whose origin is near");
    return std::nullopt;
  }
  const double length = Eigen::Vector4d(qx, qy, qz, qw).norm();
  if (!(std::abs(length - 1) <= kUnitQuaternion)) {
    folder.Tell(file, record.line,
                fmt::format("expected a unit quaternion, found one of length {:.6f}", length),
                "normalise qx qy qz qw (in this order)");
    return std::nullopt;
  }
  return StampedPose{stamp_s, {RotationOf(qx, qy, qz, qw), t}, record.line};
}

}  // namespace

Trajectory ReadTrajectory(Folder& folder, const std::string& file, Severity repetition) {
  Trajectory trajectory;
  StampOrder order(folder, file, Severity::kWarning, repetition);
  for (const io::TextRecord& record : ReadTextRecords(folder, file)) {
    const auto pose = ReadPose(folder, file, record);
    if (!pose) continue;
    order.Next(pose->stamp_s, record.line);
    trajectory.push_back(*pose);
  }
  order.Finish();
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_s < b.stamp_s; });
  return trajectory;
}

Trajectory ReadGroundtruth(Folder& folder) {
  const std::string file = "groundtruth.txt";
  Trajectory truth = ReadTrajectory(folder, file);
  if (truth.empty()) {
    folder.Tell(file, 0, "holds no pose", "write the poses of the camera, or remove the file");
  }
  return truth;
}

}  // namespace eval
