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
  std::string camera;  ///< tum1, tum2, tum3 or a file; empty: SEQ/camera.yaml
  /// Told what should be known of run and sequence beside the pictures; may be empty.
  std::function<void(const std::string& warning)> warn = {};
};

struct Picture {
  std::string name;  ///< "top_view.png"
  cv::Mat image;     ///< 8-bit BGR
};

/// Draws a run: contact_sheet.png, top_view.png, and error_over_time.png when there is a truth.
/// The same folders give the same pixels. @throws InputError for folders that cannot be read
std::vector<Picture> DrawRun(const std::filesystem::path& run, const DrawOptions& options);

/// Writes the pictures into a folder of their own, all or none: under a temporary name, then
/// renamed. @throws InputError when the folder exists and `force` is not set, or on failure to
/// write
void WritePictures(const std::vector<Picture>& pictures, const std::filesystem::path& folder,
                   bool force);

}  // namespace eval
