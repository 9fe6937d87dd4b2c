#pragma once

#include <filesystem>
#include <string>

namespace io {

/// What a folder, or the file in its place, seems to be, by the names in it.
enum class FolderKind {
  kNothing,      ///< there is nothing
  kFile,         ///< no folder
  kEmpty,        ///< a folder without anything
  kSequence,     ///< of `pas sim`, or a recording in TUM's format
  kRun,          ///< of `pas slam`
  kPictures,     ///< of `pas draw`
  kExport,       ///< of `pas export`
  kRosBag,       ///< of ROS: FILE.bag, or metadata.yaml beside *.db3 or *.mcap
  kScanNet,      ///< FILE.sens, or color/, depth/ and pose/
  kSevenScenes,  ///< frame-000000.color.png (BundleFusion: .jpg) and so on
  kIclNuim,      ///< scene_00_0000.png and scene_00_0000.depth
  kReplica,      ///< results/frame000000.jpg, results/depth000000.png and traj.txt
  kImages,       ///< images without a list of them
  kOther         ///< none of these
};

/// @throws InputError when it cannot be read
FolderKind KindOf(const std::filesystem::path& folder);

/// What stands there and was not expected, and what to do: "is a sequence, expected a run
/// folder (run.json); make one of it with `pas slam seq -o RUN`".
struct WrongFolder {
  std::string what, mend;
};
/// @param expected  kSequence, kRun or kOther, which is either
WrongFolder Unexpected(const std::filesystem::path& folder, FolderKind found,
                       FolderKind expected);

/// Whether it is the file of a bag of ROS 1: FILE.bag.
bool IsBagFile(const std::filesystem::path& path);

/// @throws InputError that says what the folder is instead, see Unexpected
void RequireSequence(const std::filesystem::path& folder);
void RequireRun(const std::filesystem::path& folder);
/// A sequence, or the file of a bag.
void RequireRecording(const std::filesystem::path& recording);

}  // namespace io
