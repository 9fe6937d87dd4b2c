#include "eval/read/trajectory_file.h"

#include <array>
#include <stdexcept>

#include "eval/read/input_error.h"
#include "eval/read/text_table.h"

namespace eval {

Trajectory ReadTrajectory(const std::filesystem::path& file) {
  constexpr std::array<const char*, 8> kFields = {"timestamp", "tx", "ty", "tz",
                                                  "qx",        "qy", "qz", "qw"};
  Trajectory trajectory;
  for (const TextLine& line : ReadTextTable(file)) {
    if (line.fields.size() != kFields.size()) {
      throw InputError(Where(file, line.number),
                       "expected 8 fields \"timestamp tx ty tz qx qy qz qw\", found " +
                           std::to_string(line.fields.size()));
    }
    std::array<double, 8> v{};
    for (std::size_t i = 0; i < v.size(); ++i) {
      v[i] = ParseNumber(line.fields[i], kFields[i], file, line.number);
    }
    try {
      trajectory.push_back(
          {v[0], {RotationOf(v[4], v[5], v[6], v[7]), Eigen::Vector3d(v[1], v[2], v[3])}});
    } catch (const std::invalid_argument&) {
      throw InputError(Where(file, line.number), "expected a unit quaternion \"qx qy qz qw\"");
    }
  }
  return trajectory;
}

}  // namespace eval
