#pragma once

#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// Plan (from above, y up the page) and elevation (from -y) of what is not floor or wall, as
/// one SVG with a scale bar; each thing with regular tops carries its name and the step in mm of
/// each of them to what is under it. What moves is drawn at the first point of its way. The same
/// scene gives the same bytes.
std::string SceneSvg(const Scene& scene);

}  // namespace sim
