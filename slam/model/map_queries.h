#pragma once

#include <vector>

#include "slam/model/map.h"

namespace slam {

/// The point that `point` has become by fusion, or kNone when it was culled (or is kNone).
int CurrentPoint(const Map& map, int point);

/// The landmark that `plane` has become by fusion.
int CurrentPlane(const Map& map, int plane);

/// Pose of a keyframe, whether culled or not.
Pose KeyframePose(const Map& map, int keyframe);

/// Ids of the keyframes that share the most points with it, most first (lower id at a tie), at
/// most `count`.
std::vector<int> BestCovisible(const Map& map, int keyframe, int count);

}  // namespace slam
