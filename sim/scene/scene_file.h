#pragma once

#include <filesystem>
#include <string>

#include "sim/scene/scene.h"

namespace sim {

inline constexpr const char* kSceneFormat = "pas-scene/1";

/// Reads a scene file (scenes/README.md describes it): lengths in metres, angles in degrees,
/// the unit in the key's name. Strict: an unknown or repeated key, a wrong type, a size that is
/// not positive and finite, or geometry that cannot be (CheckScene) is an error.
/// @throws InputError with file:line, what was expected and how to mend it.
Scene ReadScene(const std::filesystem::path& path);

/// The same from text already in memory; `name` stands for the file in messages, and its folder
/// is where meshes are looked for.
Scene ParseScene(const std::string& text, const std::string& name);

/// The canonical text of a scene; ParseScene gives the same scene back, bit for bit.
/// (Angles of `motion` in radians that no number of degrees gives are moved by one ulp.)
std::string SceneText(const Scene& scene);

/// Writes the canonical text, whole or not at all.
/// @throws InputError when the file cannot be written.
void WriteScene(const Scene& scene, const std::filesystem::path& path);

/// SHA-256 of the canonical text, 64 hexadecimal digits.
std::string SceneHash(const Scene& scene);

}  // namespace sim
