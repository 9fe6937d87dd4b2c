#include "slam/mapping/plane_trial.h"

#include <algorithm>

#include "slam/associate/plane_overlap.h"

namespace slam {
namespace {

bool MissedTooOften(const MapPlane& candidate, int frame_index, const PlaneMapConfig& config) {
  const int missed = frame_index - candidate.first_frame + 1 - candidate.observations;
  return missed > std::max(config.max_trial_misses, candidate.observations / 2);
}

/// Most of what the frame sees of the candidate are segments in an unstructured object's box.
bool LiesOnUnstructured(const MapPlane& candidate, const Frame& frame, const Camera& camera) {
  const PlaneView view = ViewMapPlane(candidate, frame, frame.T_cw, camera);
  int unstructured = 0;
  for (std::size_t f = 0; f < frame.planes.size(); ++f) {
    if (frame.planes[f].bad == BadReason::kUnstructured) unstructured += view.landed[f];
  }
  return 2 * unstructured > view.expected;
}

}  // namespace

bool IsGood(const FramePlane& plane, const PlaneMapConfig& config) {
  return !plane.bad && plane.centroid_c.norm() < config.max_distance_m &&
         !plane.points_c.empty();
}

bool HasProvenItself(const MapPlane& candidate, const PlaneMapConfig& config) {
  return candidate.observations >= config.trial_frames &&
         candidate.seen_px >= config.trial_pixels;
}

void EraseFailedCandidates(const Frame& frame, const Camera& camera,
                           const PlaneMapConfig& config, Map& map) {
  map.planes.EraseCandidates([&](const MapPlane& candidate) {
    return MissedTooOften(candidate, frame.index, config) ||
           LiesOnUnstructured(candidate, frame, camera);
  });
}

}  // namespace slam
