#pragma once

#include <optional>
#include <string>

#include "sim/scene/scene.h"

namespace sim {

/// What cannot be in a scene.
struct SceneFault {
  std::size_t object = 0;  ///< index into Scene::objects
  std::string what;        ///< with how to mend it
};

/// The first fault: a repeated id or name, an object below the floor, two objects in one place.
/// The floor is the top of the object of class "floor", z = 0 when there is none. Touching is
/// allowed (kTouch_m); toys count as their boxes, of a mesh only corners are looked for in the
/// boxes of others, and of two meshes a fault is found only where each has corners in the other's
/// box. Cost: O(objects^2).
std::optional<SceneFault> FindFault(const Scene& scene);

}  // namespace sim
