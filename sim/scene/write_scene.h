#pragma once

#include <filesystem>
#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// The canonical text of a scene; ParseScene gives the same scene back, bit for bit.
/// (Angles of `motion` in radians that no number of degrees gives are moved by one ulp.)
std::string SceneText(const Scene& scene);

/// Writes the canonical text, whole or not at all.
/// @throws InputError when the file cannot be written.
void WriteScene(const Scene& scene, const std::filesystem::path& path);

/// SHA-256 of the canonical text, 64 hexadecimal digits.
std::string SceneHash(const Scene& scene);

}  // namespace sim
