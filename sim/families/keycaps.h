#pragma once

#include "sim/scene/scene.h"

namespace sim {

/// Cuts each block of keys of a scene's keyboards into single caps, 3/4 inch from key to key
/// and 3 mm apart, within the block. Caps are detected with their keyboard; their role is
/// `other`, as their faces are too small to score. The first cap of a block has its id, the
/// rest have new ones at the end.
void PutKeycaps(Scene& scene);

}  // namespace sim
