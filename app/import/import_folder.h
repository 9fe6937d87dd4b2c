#pragma once

#include <string>

namespace app {

struct ImportArguments {
  std::string recording, output, camera, registration;
  bool force = false;
};

/// Copies a folder whose depth is an image of a camera of its own, and lays its depth on colour
/// as --depth-registration says. Colour, poses and detections stay what they are.
/// @returns the exit code
/// @throws InputError
int ImportFolder(const ImportArguments& arguments, bool quiet);

}  // namespace app
