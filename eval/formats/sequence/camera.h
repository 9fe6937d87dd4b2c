#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>

#include "eval/formats/folder.h"
#include "eval/formats/json_record.h"

namespace eval {

/// Pinhole camera of camera.yaml, with its distortion; pixel centres are whole numbers, the
/// first at (0, 0).
struct Camera {
  int width = 0, height = 0;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< pixels
  double fps = 0.0;
  double depth_factor = 0.0;           ///< depth image units per metre
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3, OpenCV's order

  bool distorted() const { return distortion != std::array<double, 5>{}; }
};

/// Pixel of a point with z > 0, by Brown's model of the lens as OpenCV documents it. Far
/// outside the image the model may fold back.
Eigen::Vector2d PixelOf(const Camera& camera, const Eigen::Vector3d& x_c);

/// Taken where a file names none, as `pas slam` does.
inline constexpr double kUsualRate_Hz = 30.0;

/// The camera that truth is of, where camera.yaml is told with a calibration's error.
inline constexpr const char* kTrueCamera = "gt/camera.yaml";

/// Reads a camera.yaml. Nothing is returned when a key is at fault.
/// @param mend  what to do when the file cannot be read
std::optional<Camera> ReadCamera(Folder& folder, const std::string& file = "camera.yaml",
                                 const std::string& mend = "");

/// Reads gt/camera.yaml, which the format does not ask for: one without the keys of a camera is
/// passed over with a warning, and nothing is returned.
std::optional<Camera> ReadTrueCamera(Folder& folder);

/// The same keys in an object of JSON, as run.json has them; nothing when one is missing.
/// @param record  Optional(), within an Extra() of the run: what another system writes is its own
std::optional<Camera> ReadCamera(const JsonRecord& record);

}  // namespace eval
