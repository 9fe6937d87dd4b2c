#pragma once

#include <filesystem>
#include <string>

#include "slam/calibrate/depth_warp.h"

namespace slam {

/// Format "pas-depth-warp/1", YAML (docs/calibration.md).
/// @throws InputError with file:line, also for an image of another size than the camera's
DepthWarp ReadWarp(const std::filesystem::path& file, const Camera& camera);

/// @param comment  for the reader, a line
std::string WarpText(const DepthWarp& warp, const std::string& comment);

}  // namespace slam
