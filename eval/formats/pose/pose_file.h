#pragma once

#include <filesystem>
#include <vector>

#include "eval/formats/folder.h"
#include "eval/formats/pose/pose.h"

namespace eval {

/// How a file of poses is written.
enum class PoseFileKind {
  kTum,    ///< `t tx ty tz qx qy qz qw`, seconds
  kKitti,  ///< the first three rows of T_wc, twelve numbers; a line a frame, without time
  kEuroc,  ///< csv: nanoseconds, position, quaternion with w first, and more columns at will
};
const char* NameOf(PoseFileKind kind);

/// A trajectory as any program writes it, metres. Poses of a KITTI file have their place in the
/// file, from 0, as stamps.
struct PoseFile {
  std::filesystem::path path;
  PoseFileKind kind = PoseFileKind::kTum;
  Trajectory poses;             ///< by rising stamp
  std::vector<Fault> warnings;  ///< stamps that come again
};

/// Reads a file of poses, whose kind is seen from its first record.
/// @throws InputError with file and line for a record of another form, a number that is none, and
///   times that go back; also for a file with fewer than two poses
PoseFile ReadPoseFile(const std::filesystem::path& path);

}  // namespace eval
