#include "slam/tracking/keyframe_decision.h"

#include <algorithm>
#include <cmath>

#include "slam/base/require.h"

namespace slam {
namespace {

constexpr int kMinTracked = 15;  // points; with fewer a pose is not worth keeping: ORB-SLAM2
constexpr double kFullFeatures = 1000.0;  // an image for which the bounds on points are meant

/// Number of a keyframe's points that others see as well; all, while there are no others.
int WellSeenPoints(const Map& map, int keyframe) {
  const auto alive = std::count_if(map.keyframes.begin(), map.keyframes.end(),
                                   [](const Keyframe& k) { return !k.culled; });
  const std::size_t min_views = alive <= 2 ? 1 : alive == 3 ? 2 : 3;
  int count = 0;
  for (const int point : map.keyframes.at(static_cast<std::size_t>(keyframe)).map_points) {
    if (point == kNone) continue;
    if (map.points[static_cast<std::size_t>(point)].observations.size() >= min_views) ++count;
  }
  return count;
}

/// Whether no keyframe has seen the point from nearly where the camera is.
bool LooksNew(const Map& map, const MapPoint& point, const Eigen::Vector3d& camera_w,
              double min_cosine) {
  const Eigen::Vector3d view_w = (point.p_w - camera_w).normalized();
  const auto seen_so = [&](const auto& observation) {
    const Pose& T_cw = map.keyframes[static_cast<std::size_t>(observation.first)].T_cw;
    const Eigen::Vector3d ray_w = T_cw.R.transpose() * (T_cw * point.p_w);
    return ray_w.dot(view_w) >= min_cosine * ray_w.norm();
  };
  return std::none_of(point.observations.begin(), point.observations.end(), seen_so);
}

/// Number of the frame's points that no keyframe has seen from nearly where the camera is.
int CountNewLooks(const Frame& frame, const Map& map, double max_view_rad) {
  const Eigen::Vector3d camera_w = Inverse(frame.T_cw).t;
  const double min_cosine = std::cos(max_view_rad);
  int count = 0;
  for (const int id : frame.map_points) {
    if (id == kNone) continue;
    const MapPoint& point = map.points[static_cast<std::size_t>(id)];
    count += LooksNew(map, point, camera_w, min_cosine) ? 1 : 0;
  }
  return count;
}

/// The bounds on numbers of points are meant for an image with that many features.
double ShareOfFeatures(const Frame& frame) {
  return std::min(1.0, static_cast<double>(frame.features.size()) / kFullFeatures);
}

/// Mean distance of the planes' middles; 0 without planes.
double PlaneDistance_m(const Frame& frame) {
  double sum_m = 0.0;
  for (const FramePlane& plane : frame.planes) sum_m += plane.centroid_c.norm();
  return frame.planes.empty() ? 0.0 : sum_m / static_cast<double>(frame.planes.size());
}

}  // namespace

KeyframeEvidence DecideKeyframe(const Frame& frame, const Map& map, int reference,
                                int frames_since_last, double close_m,
                                const KeyframeDecisionConfig& config) {
  Require(frame.map_points.size() == frame.features.size(),
          "DecideKeyframe: map_points is not parallel to features");
  // Count the features with a map point, and those near enough to give a new one.
  KeyframeEvidence evidence;
  for (std::size_t f = 0; f < frame.features.size(); ++f) {
    const bool tracked = frame.map_points[f] != kNone;
    const double z = frame.features[f].depth_m;
    if (tracked) ++evidence.tracked;
    if (z > 0 && z < close_m) ++(tracked ? evidence.close_tracked : evidence.close_untracked);
  }
  evidence.reference_points = WellSeenPoints(map, reference);
  if (frames_since_last < config.min_frames_between || evidence.tracked <= kMinTracked) {
    return evidence;
  }
  // Insert when the frame sees less, lacks close points, or looks at the map from a new side.
  const double ratio =
      map.keyframes.size() < 2 ? config.first_reference_ratio : config.min_reference_ratio;
  const double share = ShareOfFeatures(frame);
  const bool sees_less = evidence.tracked < ratio * evidence.reference_points;
  const bool close_to_be_had = evidence.close_tracked < share * config.min_close_tracked &&
                               evidence.close_untracked > share * config.min_close_untracked;
  evidence.new_looks = CountNewLooks(frame, map, config.max_view_rad);
  const bool looks_new = evidence.new_looks > config.max_new_ratio * evidence.tracked;
  evidence.wanted = sees_less || close_to_be_had || looks_new;
  return evidence;
}

bool KeepViewOfPlanes(const Frame& frame, const Keyframe& newest, int followed,
                      const KeyframeDecisionConfig& config) {
  if (frame.index - newest.frame_index < config.min_frames_between) return false;
  if (followed > ShareOfFeatures(frame) * config.min_close_untracked) return true;
  // A landmark is tied to a keyframe that knows as little of where it is as the frame that made it.
  const auto is_new = [](const PlaneMatch& match) {
    return match.decision == PlaneDecision::kNew;
  };
  if (std::any_of(frame.plane_matches.begin(), frame.plane_matches.end(), is_new)) return true;
  const double moved_m = (Inverse(frame.T_cw).t - Inverse(newest.T_cw).t).norm();
  return RotationAngle(frame.T_cw, newest.T_cw) > config.max_view_rad ||
         moved_m > config.max_view_rad * PlaneDistance_m(frame);
}

}  // namespace slam
