#pragma once

#include <vector>

#include "slam/model/frame_plane.h"
#include "slam/structure/structure.h"

namespace slam {

/// Whether planes alone can hold a camera from here on. Some two of them that are large enough to be
/// landmarks at first sight and far from parallel leave at most one direction to its motion; where
/// all of these face one way, two of their edges that are far from parallel hold it (edges_alone).
/// @param image_px  pixels of the depth image
bool PlanesCanStart(const std::vector<FramePlane>& planes, double image_px,
                    const StructureConfig& config);

}  // namespace slam
