#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "io/output_folder.h"
#include "slam/geometry/camera.h"

namespace app {

inline constexpr const char* kImportedFrom =
    "imported_from.txt";  ///< marks a folder of `pas import`

/// The images of a sequence folder that is imported, with its lists.
class ImportedFiles {
 public:
  /// @param folder  must outlive it
  /// @param camera  of the images to be written
  ImportedFiles(io::OutputFolder& folder, const slam::Camera& camera)
      : folder_(folder), camera_(camera) {}

  /// Adds a frame. @param colour  bytes of the file; @param extension  its kind, ".png"
  void Add(double stamp_s, std::string_view colour, const std::string& extension,
           double depth_stamp_s, const cv::Mat1f& depth_m);

  /// Writes lists, camera.yaml and where it all comes from.
  void Finish(const std::string& origin);

  /// Pixels of depth that 16 bits do not hold, and which are 0 therefore.
  long too_far() const { return too_far_; }

 private:
  io::OutputFolder& folder_;
  slam::Camera camera_;
  std::string pairs_, colour_list_, depth_list_;
  long too_far_ = 0;
};

/// Warns of depth that was left out.
void WarnOfFarDepth(const ImportedFiles& files, double depth_factor);

}  // namespace app
