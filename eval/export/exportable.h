#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <string>
#include <vector>

#include "eval/formats/sequence/sequence.h"
#include "io/output_folder.h"

namespace eval {

/// The file that marks a folder as an export.
inline constexpr const char* kExportMarker = "export.json";

struct ExportOptions {
  bool structure = false;    ///< also desk, floor, walls
  bool force = false;        ///< replace an older export
  std::string version = {};  ///< the program's, for the dataset's description
  std::function<void(int done, int total)> progress = {};  ///< frames; may be empty
  /// Told what should be known of a sequence that is exported all the same; may be empty.
  std::function<void(const std::string& warning)> warn = {};
};

struct ExportSummary {
  int images = 0;
  int instances = 0;  ///< annotations of all images
  int kinds = 0;      ///< categories, or models
  int left_out = 0;   ///< objects of the scenes that the format cannot hold
};

/// A sequence that can be exported: it is complete and has a camera, gt/scene.json and
/// gt/object_id.
/// @throws InputError that names what is missing
Sequence ReadExportable(const std::filesystem::path& folder, const ExportOptions& options);

/// The bytes of an image of the sequence, relative to its folder.
/// @throws InputError naming it when it cannot be read, or its header tells another size than the
///   camera has
std::string ReadImageBytes(const Sequence& sequence, const std::filesystem::path& image);

/// The same of a colour image, which can be decoded.
/// @throws InputError also when it cannot
std::string ReadColourBytes(const Sequence& sequence, const std::filesystem::path& image);

/// Object ids of a frame.
/// @throws InputError naming the file when it is missing, has another size than the camera, or
///   holds an id that the scene does not have
cv::Mat1w ReadCheckedObjectIds(const Sequence& sequence, double stamp_s);

/// Pose of each frame, T_gc. A simulator's n-th pose is that of the n-th frame, whatever its
/// stamp says; else they are matched by stamp.
/// @throws InputError for a frame without a pose
std::vector<Pose> FramePoses(const Sequence& sequence);

/// Writes the marker, which says what `kind` of export it is, and puts the folder in its place.
void CommitExport(io::OutputFolder& folder, const std::string& kind);

}  // namespace eval
