#include "eval/formats/pose/trajectory.h"

#include <algorithm>

#include "eval/formats/pose/pose_record.h"
#include "eval/formats/stamps.h"

namespace eval {
namespace {

/// Nothing when the line is at fault, which is told.
std::optional<StampedPose> ReadTumPose(Folder& folder, const std::string& file,
                                       const io::TextRecord& record) {
  const auto v = NumbersOf(record);
  if (!v || v->size() != kTumFields) {
    folder.Tell(
        file, record.line,
        "expected `t tx ty tz qx qy qz qw`, eight finite numbers, found " + TextOf(record),
        "write the pose of the camera in the world, or drop the line");
    return std::nullopt;
  }
  const auto T_wc = PoseFrom({folder, file, record.line}, Eigen::Vector3d(v->data() + 1),
                             Eigen::Vector4d(v->data() + 4));
  if (!T_wc) return std::nullopt;
  return StampedPose{v->front(), *T_wc, record.line};
}

}  // namespace

Trajectory ReadTrajectory(Folder& folder, const std::string& file,
                          const std::vector<io::TextRecord>& records, StampFaults faults) {
  Trajectory trajectory;
  StampOrder order(folder, file, faults.disorder, faults.repetition);
  for (const io::TextRecord& record : records) {
    const auto pose = ReadTumPose(folder, file, record);
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

Trajectory ReadTrajectory(Folder& folder, const std::string& file, StampFaults faults) {
  return ReadTrajectory(folder, file, ReadTextRecords(folder, file), faults);
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
