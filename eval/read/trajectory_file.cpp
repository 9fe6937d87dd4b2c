#include "eval/read/trajectory_file.h"

#include <array>
#include <stdexcept>

#include "io/input_error.h"
#include "io/text_table.h"

namespace eval {

Trajectory ReadTrajectory(const std::filesystem::path& file) {
  constexpr std::array<const char*, 8> kFields = {"timestamp", "tx", "ty", "tz",
                                                  "qx",        "qy", "qz", "qw"};
  Trajectory trajectory;
  for (const io::TextRecord& record : io::ReadRecords(file, "timestamp tx ty tz qx qy qz qw")) {
    std::array<double, 8> v{};
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = record.Number(i, kFields[i]);
    try {
      trajectory.push_back(
          {v[0], {RotationOf(v[4], v[5], v[6], v[7]), Eigen::Vector3d(v[1], v[2], v[3])}});
    } catch (const std::invalid_argument&) {
      throw io::InputError(record.where, "expected a unit quaternion \"qx qy qz qw\"");
    }
  }
  return trajectory;
}

}  // namespace eval
