#pragma once

#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// Plan (from above, y up the page) and elevation (from -y) of what is not floor or wall, as
/// one SVG with a scale bar; each thing with a regular top carries its name and the step of its last one to what is under it
/// in mm. The same scene gives the same bytes.
std::string SceneSvg(const Scene& scene);

}  // namespace sim
