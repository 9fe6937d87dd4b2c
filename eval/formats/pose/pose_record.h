#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/pose/pose.h"
#include "eval/formats/text_records.h"

namespace eval {

/// Fields of a pose as the tools of the TUM data sets write it: t tx ty tz qx qy qz qw.
inline constexpr std::size_t kTumFields = 8;

/// Where a record stands, for what is told of it.
struct RecordPlace {
  Folder& folder;
  const std::string& file;
  int line = 0;
};

/// The fields of the record, all of them finite numbers; nothing when one is none.
std::optional<std::vector<double>> NumbersOf(const io::TextRecord& record);

/// A pose as files print it. Quaternions of unit length are normalised once more, for their last
/// digits. Nothing when a number is out of its range, which is told.
std::optional<Pose> PoseFrom(const RecordPlace& place, const Eigen::Vector3d& t,
                             const Eigen::Vector4d& q_xyzw);

/// The same from a rotation matrix, of which the nearest rotation is taken.
std::optional<Pose> PoseFrom(const RecordPlace& place, const Eigen::Vector3d& t,
                             const Eigen::Matrix3d& R);

}  // namespace eval
