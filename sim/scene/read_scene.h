#pragma once

#include <filesystem>
#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// Reads a scene file (scenes/README.md describes it): lengths in metres, angles in degrees,
/// the unit in the key's name. Strict: an unknown or repeated key, a wrong type, a size that is
/// not positive and finite, or geometry that cannot be (FindFault) is an error.
/// @throws InputError with file:line, what was expected and how to mend it.
Scene ReadScene(const std::filesystem::path& path);

/// The same from text already in memory; `name` stands for the file in messages, and its folder
/// is where meshes are looked for.
Scene ParseScene(const std::string& text, const std::string& name);

}  // namespace sim
