#pragma once

#include <filesystem>
#include <string>

#include "slam/geometry/camera.h"

namespace slam {

/// Reads a camera.yaml (formats.md): model (pinhole), width, height, fx, fy, cx, cy; optional
/// fps, depth_factor and Brown's k1 k2 p1 p2 k3.
/// @throws InputError with file:line for a missing, unknown or impossible value.
Camera ReadCamera(const std::filesystem::path& file);

/// The camera of a run: `choice` is tum1, tum2, tum3, a file, or empty for SEQ/camera.yaml.
/// @throws InputError; without camera.yaml it says to pass --camera.
Camera ChooseCamera(const std::string& choice, const std::filesystem::path& sequence);

}  // namespace slam
