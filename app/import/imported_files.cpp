#include "app/import/imported_files.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "app/console/console.h"
#include "io/image/encode_png.h"
#include "io/number_text.h"

namespace app {
namespace {

std::string CameraText(const slam::Camera& camera) {
  std::string text = "model: pinhole\n";
  const auto add = [&text](const char* key, double value) {
    text += fmt::format("{}: {}\n", key, io::NumberText(value));
  };
  add("width", camera.width), add("height", camera.height);
  add("fx", camera.fx), add("fy", camera.fy), add("cx", camera.cx), add("cy", camera.cy);
  add("k1", camera.k1), add("k2", camera.k2), add("p1", camera.p1), add("p2", camera.p2);
  add("k3", camera.k3);
  add("depth_factor", camera.depth_factor), add("fps", camera.fps);
  return text;
}

/// Depth as a sequence folder keeps it. What 16 bits do not hold becomes 0.
/// @param too_far  counts it
cv::Mat1w RawDepth(const cv::Mat1f& depth_m, double depth_factor, long& too_far) {
  cv::Mat1w raw(depth_m.size(), std::uint16_t{0});
  for (int v = 0; v < depth_m.rows; ++v) {
    for (int u = 0; u < depth_m.cols; ++u) {
      const double units = std::round(depth_factor * static_cast<double>(depth_m(v, u)));
      const bool fits = units >= 0 && units < std::numeric_limits<std::uint16_t>::max();
      if (fits) raw(v, u) = static_cast<std::uint16_t>(units);
      too_far += !fits;
    }
  }
  return raw;
}

}  // namespace

void ImportedFiles::Add(double stamp_s, std::string_view colour, const std::string& extension,
                        double depth_stamp_s, const cv::Mat1f& depth_m) {
  const std::string colour_file = fmt::format("rgb/{:.6f}{}", stamp_s, extension);
  const std::string depth_file = fmt::format("depth/{:.6f}.png", depth_stamp_s);
  folder_.Write(colour_file, colour);
  folder_.Write(depth_file, io::EncodePng(RawDepth(depth_m, camera_.depth_factor, too_far_)));
  const std::string colour_line = fmt::format("{:.6f} {}", stamp_s, colour_file);
  const std::string depth_line = fmt::format("{:.6f} {}", depth_stamp_s, depth_file);
  pairs_ += colour_line + " " + depth_line + "\n";
  colour_list_ += colour_line + "\n";
  depth_list_ += depth_line + "\n";
}

void ImportedFiles::Finish(const std::string& origin) {
  folder_.Write("rgb.txt", colour_list_);
  folder_.Write("depth.txt", depth_list_);
  folder_.Write("camera.yaml", CameraText(camera_));
  folder_.Write("associations.txt", pairs_);
  folder_.Write(kImportedFrom, origin + "\n");
}

void WarnOfFarDepth(const ImportedFiles& files, double depth_factor) {
  if (files.too_far() == 0) return;
  PrintWarning(fmt::format(
      "{} pixels of depth are left out: 16 bits at {} a metre end at {:.1f} m", files.too_far(),
      depth_factor, std::numeric_limits<std::uint16_t>::max() / depth_factor));
}

}  // namespace app
