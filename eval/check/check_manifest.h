#pragma once

#include <string>

#include "eval/formats/folder.h"

namespace eval {

/// Checks manifest.json: format, completeness, frame count, and the sha256 of every file.
/// @param frames  how many colour images rgb.txt lists
/// @returns the name of the sensor, empty when the manifest is absent or does not tell, and where
///   parameters of it were set to something else
std::string CheckManifest(Folder& folder, int frames);

}  // namespace eval
