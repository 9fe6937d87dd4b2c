#pragma once

#include <map>
#include <optional>
#include <vector>

#include "slam/model/frame.h"
#include "slam/model/map.h"

namespace slam {

/// The point that `point` has become by fusion, or kNone when it was culled (or is kNone).
int CurrentPoint(const Map& map, int point);

/// The landmark that `plane` has become by fusion.
int CurrentPlane(const Map& map, int plane);

/// Frames that saw the two surfaces side by side mostly showed a step between them.
bool StepLiesBetween(const MapPlane& one, const MapPlane& other);

/// Position in vertices_w of the corner nearest to p_w. Nothing: none is nearer than max_gap_m.
std::optional<std::size_t> NearestVertex(const MapPlane& map_plane, const Eigen::Vector3d& p_w,
                                         double max_gap_m);

/// Pose of a keyframe, whether culled or not.
Pose KeyframePose(const Map& map, int keyframe);

/// The keyframe, not culled, that a camera at T_cw is nearest to; a radian counts as a metre.
/// @returns kNone when there is none
int NearestKeyframe(const Map& map, const Pose& T_cw);

/// Ids of the points that these keyframes see, each once, ascending.
std::vector<int> PointsSeenBy(const std::vector<int>& keyframes, const Map& map);

/// Number of keyframes, culled ones among them, that were taken after the frame of this index.
int KeyframesAfter(const Map& map, int frame_index);

/// A feature of a frame and the map point that it was matched to.
struct MatchedPoint {
  std::size_t feature;
  int point;
};

/// The frame's matches with points that the map holds and that were not culled.
std::vector<MatchedPoint> MatchedPoints(const Frame& frame, const Map& map);

/// The ids that were counted, most often counted first (lower id at a tie).
std::vector<int> MostCountedFirst(const std::map<int, int>& count_of_id);

/// Ids of the keyframes that share the most points with it, most first (lower id at a tie), at
/// most `count`.
std::vector<int> BestCovisible(const Map& map, int keyframe, int count);

}  // namespace slam
