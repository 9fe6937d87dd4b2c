#pragma once

#include <vector>

#include "sim/scene/scene.h"
#include "sim/scene/yaml_value.h"

namespace sim {

/// The list `lights` of a scene file.
/// @throws InputError with file:line for what is no light, or is none that could be.
std::vector<Light> ReadLights(const YamlValue& value);

}  // namespace sim
