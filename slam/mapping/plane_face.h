#pragma once

#include "slam/mapping/plane_map_config.h"
#include "slam/model/map_plane.h"

namespace slam {

/// Its four corners have been seen often enough to say where the surface ends.
bool KnowsItsFace(const MapPlane& map_plane, const PlaneMapConfig& config);

/// Forgets corners below min_corner_weight; last of all, for evidence adds up.
void ForgetDoubtfulCorners(MapPlane& map_plane, const PlaneMapConfig& config);

/// Takes points out of the clouds that lie beyond the face's sides by more than
/// `face_margin_m`: pieces of other things that lie in the plane's extension and were once
/// segmented with it. For planes that know their face.
void KeepWhatLiesOnFace(MapPlane& map_plane, const PlaneMapConfig& config);

}  // namespace slam
