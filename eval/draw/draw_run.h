#pragma once

#include <filesystem>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

namespace eval {

struct DrawOptions {
  int frames = 12;                             ///< on the contact sheet
  std::optional<std::filesystem::path> truth;  ///< the sequence; by default the one in run.json
  std::string camera;                 ///< tum1, tum2, tum3 or a file; empty: SEQ/camera.yaml
  std::filesystem::path output = {};  ///< where the pictures will go, refused before the work
  bool force = false;                 ///< they replace those of an earlier drawing
  /// Told what should be known of run and sequence beside the pictures; may be empty.
  std::function<void(const std::string& warning)> warn = {};
};

struct Picture {
  std::string name;  ///< "top_view.png"
  cv::Mat image;     ///< 8-bit BGR
};

/// The pictures of a run, and what its user should know of them, a sentence each: what is
/// missing, why, and how to get it.
struct Drawing {
  std::vector<Picture> pictures;
  std::vector<std::string> notes;
};

/// Draws a run: contact_sheet.png, top_view.png, and error_over_time.png when there is a true
/// trajectory. The same folders give the same pixels.
/// @throws InputError for folders that cannot be read, a run of another sequence, an output that
///   exists and is not to be replaced (WritePictures), or that holds one of the two folders
Drawing DrawRun(const std::filesystem::path& run, const DrawOptions& options);

/// Writes the pictures into a folder of their own, all or none: under temporary names, then
/// renamed. In a folder that exists, only pictures of these names and those that an earlier
/// drawing left are replaced.
/// @throws InputError when the folder exists, is not empty, and `force` is off or it holds no
///   pictures of a run; or on failure to write
void WritePictures(const std::vector<Picture>& pictures, const std::filesystem::path& folder,
                   bool force);

}  // namespace eval
