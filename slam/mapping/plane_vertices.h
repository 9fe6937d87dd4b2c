#pragma once

#include <vector>

#include "slam/mapping/plane_map_config.h"
#include "slam/model/frame_plane.h"
#include "slam/model/map_plane.h"

namespace slam {

/// Fuses the four corners of one observation into those of a map plane.
///
/// The corners are laid onto the known ones by the turn (and sense) around the face that moves
/// them least. A corner within `max_vertex_jump_m` is averaged by weight; one farther off
/// counts against the known corner, and takes its place when the evidence is used up. A corner
/// weighs (3 mm)^2 over that plus its variance within the plane, and a quarter of it if it
/// follows from its lines alone. Corners end on the map plane.
/// An observation with fewer corners adds those that were seen and lie within
/// max_vertex_jump_m of known ones.
void FuseVertices(MapPlane& map_plane, const std::vector<Vertex>& vertices_c, const Pose& T_wc,
                  const PlaneMapConfig& config);

}  // namespace slam
