#include "eval/formats/trajectory.h"

#include <fmt/format.h>

#include <array>

#include "eval/formats/stamps.h"
#include "eval/formats/text_records.h"
#include "io/number_text.h"

namespace eval {
namespace {

// Four decimals, as TUM prints them, are off by up to 5e-5 each: the norm by at most 1e-4.
constexpr double kUnitQuaternion = 1e-3;
constexpr double kMinQuaternion = 1e-9;  // RotationOf finds no direction in a shorter one

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

}  // namespace

Trajectory ReadTrajectory(Folder& folder, const std::string& file) {
  Trajectory trajectory;
  StampOrder order(folder, file);
  for (const io::TextRecord& record : ReadTextRecords(folder, file)) {
    const auto v = ReadNumbers(record);
    if (!v) {
      folder.Tell(
          file, record.line,
          "expected `t tx ty tz qx qy qz qw`, eight finite numbers, found " + TextOf(record),
          "write the pose of the camera in the world, or drop the line");
      continue;
    }
    const auto& [stamp_s, tx, ty, tz, qx, qy, qz, qw] = *v;
    order.Next(stamp_s, record.line);
    const double length = Eigen::Vector4d(qx, qy, qz, qw).norm();
    const bool rotates = length > kMinQuaternion && std::isfinite(length);
    if (!(std::abs(length - 1) <= kUnitQuaternion)) {
      folder.Tell(file, record.line,
                  fmt::format("expected a unit quaternion, found one of length {:.6f}", length),
                  "normalise qx qy qz qw (in this order)",
                  rotates ? Severity::kFlaw : Severity::kFatal);
    }
    if (!rotates) continue;
    const Pose T_wc{RotationOf(qx, qy, qz, qw), Eigen::Vector3d(tx, ty, tz)};
    trajectory.push_back({stamp_s, T_wc, record.line});
  }
  order.Finish();
  return trajectory;
}

}  // namespace eval
