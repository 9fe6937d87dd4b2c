#pragma once

#include <array>
#include <optional>

#include "eval/check/fault.h"

namespace eval {

/// camera.yaml as the checks need it. Pixel (0, 0) is the centre of the first pixel.
struct CheckedCamera {
  int width = 0, height = 0;
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double depth_factor = 0;             ///< units of the depth image per metre
  std::array<double, 5> distortion{};  ///< k1 k2 p1 p2 k3
};

/// Checks camera.yaml: keys, types and ranges. Nothing is returned when a needed key is at
/// fault.
std::optional<CheckedCamera> CheckCamera(FolderCheck& check);

}  // namespace eval
