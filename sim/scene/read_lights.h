#pragma once

#include <vector>

#include "io/yaml_value.h"
#include "sim/scene/scene.h"

namespace sim {

/// The list `lights` of a scene file.
/// @throws InputError with file:line for what is no light, or is none that could be.
std::vector<Light> ReadLights(const io::YamlValue& value);

}  // namespace sim
