#pragma once

#include "slam/features/point_projection.h"
#include "slam/model/map.h"

namespace slam {

/// Whether the points of the map say that the camera is elsewhere: it sees features where the
/// map has points, and they look otherwise. Nothing is said in the dark, nor where the map has no
/// points: planes of another place may lie as those of the map do, its prints do not.
/// @param frame  with its features
/// @param keyframe  one that looks as a camera at T_cw does
bool PointsDeny(const Frame& frame, const Map& map, const Pose& T_cw, int keyframe,
                const Camera& camera, const FeatureScale& scale,
                const PointProjectionConfig& projection, const PointMatchConfig& match);

}  // namespace slam
