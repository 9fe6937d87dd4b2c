#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/yaml_value.h"
#include "sim/scene/scene.h"

namespace sim {

/// Keys of an object that only a mesh has.
inline const std::vector<std::string> kModelKeys{"mesh",       "mesh_sha256", "scale",
                                                 "flip",       "flatness_mm", "min_plane_cm2",
                                                 "open_edges", "planes",      "origin_m"};

/// Reads the mesh that the object names, and sets model, size, and where it is: by `center_m`,
/// or by `origin_m`, the place of the file's origin. The object's rotation is known.
/// @param folder  of the scene file
/// @throws InputError
void ReadObjectModel(const io::YamlMap& map, const std::filesystem::path& folder,
                     Object& object);

/// The lines of the scene file that say all that, each with its indent.
std::string ModelText(const Object& object);

}  // namespace sim
