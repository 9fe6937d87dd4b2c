#include "slam/mapping/plane_update.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "slam/base/index.h"
#include "slam/geometry/pixel_projection.h"
#include "slam/mapping/plane_observation.h"
#include "slam/mapping/plane_split.h"
#include "slam/mapping/plane_trial.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// The landmark that each label of the frame stands for, or kNone.
std::vector<int> LandmarkOfPlane(const Frame& frame) {
  std::vector<int> landmark(frame.planes.size(), kNone);
  for (std::size_t f = 0; f < landmark.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.ShowsLandmark()) landmark[f] = match.map_plane;
  }
  return landmark;
}

/// Counts the frame for every pair of landmarks in it.
void UpdateCovisibility(const std::vector<int>& landmark, Map& map) {
  std::set<int> seen;
  for (const int id : landmark) {
    if (id != kNone) seen.insert(id);
  }
  for (const int id : seen) {
    for (const int other : seen) {
      if (other != id) ++map.planes.At(id).covisible[other];
    }
  }
}

/// Notes the steps between landmarks that the frame shows side by side.
void UpdateSteps(const Frame& frame, const std::vector<int>& landmark, Map& map) {
  std::set<std::pair<int, int>> between;  // several segments of a surface are one observation
  for (const FrameStep& step : frame.plane_steps) {
    const int one = landmark[Index(step.one)], other = landmark[Index(step.other)];
    if (one != kNone && other != kNone && one != other) between.insert(std::minmax(one, other));
  }
  for (const auto& [one, other] : between) {
    ++map.planes.At(one).stepped[other];
    ++map.planes.At(other).stepped[one];
  }
}

/// Notes the frame's matched map points that lie on its planes.
void UpdateMapPoints(const Frame& frame, const std::vector<int>& landmark, const Camera& camera,
                     double max_distance_m, Map& map) {
  if (frame.plane_labels.empty()) return;
  for (const auto& [feature, id] : MatchedPoints(frame, map)) {
    const Eigen::Vector2i u =
        RecordedPixel(camera, camera.Backproject(frame.features[feature].u_px, 1.0));
    if (u.x() < 0) continue;
    const auto label = static_cast<std::size_t>(frame.plane_labels(u.y(), u.x()));
    if (label == 0 || label > landmark.size() || landmark[label - 1] == kNone) continue;
    MapPlane& m = map.planes.At(landmark[label - 1]);
    const Eigen::Vector3d& p_w = map.points[static_cast<std::size_t>(id)].p_w;
    if (std::abs(SignedDistance(m.pi_w, p_w)) < max_distance_m) m.map_points.insert(id);
  }
}

/// Good planes that show nothing of the map start a candidate; or landmarks, where the map has
/// none yet and the segment is proof enough.
void StartCandidates(Frame& frame, double image_px, const PlaneMapConfig& config, Map& map) {
  const bool any_landmark =
      std::any_of(map.planes.begin(), map.planes.end(),
                  [](const MapPlane& m) { return m.status != LandmarkStatus::kCandidate; });
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    PlaneMatch& match = frame.plane_matches[f];
    const FramePlane& plane = frame.planes[f];
    if (match.decision != PlaneDecision::kUnmatched ||
        match.reason == MatchReason::kAmbiguous || !IsGood(plane, config)) {
      continue;
    }
    MapPlane& m = map.planes.Add(StartPlane(plane, frame));
    const bool at_once =
        config.trial_frames <= 1 || (!any_landmark && IsProofAlone(plane, image_px));
    if (at_once) m.status = LandmarkStatus::kLandmark;
    match = {at_once ? PlaneDecision::kNew : PlaneDecision::kTrial, m.id,
             MatchReason::kNothing};
  }
}

/// Makes landmarks of the candidates in this frame that have proven themselves. The largest
/// segment is the one that made it, so that one decision a landmark says "new".
void PromoteProven(Frame& frame, const PlaneMapConfig& config, Map& map) {
  std::map<int, std::size_t> largest;  // segment, by candidate
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.decision != PlaneDecision::kTrial || !IsGood(frame.planes[f], config)) continue;
    const auto [found, first] = largest.emplace(match.map_plane, f);
    if (!first && frame.planes[f].pixel_count > frame.planes[found->second].pixel_count) {
      found->second = f;
    }
  }
  for (const auto& [id, f] : largest) {
    MapPlane& m = map.planes.At(id);
    if (!HasProvenItself(m, config)) continue;
    m.status = LandmarkStatus::kLandmark;
    frame.plane_matches[f].decision = PlaneDecision::kNew;
  }
}

}  // namespace

void UpdatePlanes(Frame& frame, Map& map, const Camera& camera,
                  const AssociationConfig& association, const PlaneMapConfig& config) {
  frame.plane_matches.resize(frame.planes.size());
  StartCandidates(frame, static_cast<double>(camera.width) * camera.height, config, map);

  // Landmarks learn from whatever was matched with them, candidates from good planes alone.
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.decision == PlaneDecision::kUnmatched) continue;
    if (match.decision == PlaneDecision::kTrial && !IsGood(frame.planes[f], config)) continue;
    ObservePlane(map.planes.At(match.map_plane), frame.planes[f], frame, config);
  }
  SplitPlanes(frame, map, camera, association, config);
  PromoteProven(frame, config, map);
  EraseFailedCandidates(frame, camera, config, map);

  const std::vector<int> landmark = LandmarkOfPlane(frame);
  UpdateCovisibility(landmark, map);
  UpdateSteps(frame, landmark, map);
  UpdateMapPoints(frame, landmark, camera, config.max_point_distance_m, map);
}

}  // namespace slam
