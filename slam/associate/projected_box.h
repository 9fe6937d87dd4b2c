#pragma once

#include "slam/geometry/camera.h"
#include "slam/model/map_plane.h"

namespace slam {

/// Box of a map plane in the recorded image at T_cw, clipped to the picture: of its corners
/// when four are known, else of its hull; where part of it lies behind the camera, of the cloud
/// points in the picture. Empty when nothing of it is in the picture.
Box ProjectedBox(const MapPlane& map_plane, const Pose& T_cw, const Camera& camera);

}  // namespace slam
