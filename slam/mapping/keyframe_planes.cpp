#include "slam/mapping/keyframe_planes.h"

#include <algorithm>

#include "slam/mapping/plane_evidence.h"
#include "slam/model/map_queries.h"

namespace slam {
namespace {

/// The keyframe's plane that shows the map plane; a new one when there is none.
KeyframePlane& PlaneShowing(int map_plane, Keyframe& keyframe) {
  const auto known =
      std::find_if(keyframe.planes.begin(), keyframe.planes.end(),
                   [&](const KeyframePlane& plane) { return plane.map_plane == map_plane; });
  if (known != keyframe.planes.end()) return *known;
  keyframe.planes.emplace_back();
  keyframe.planes.back().map_plane = map_plane;
  return keyframe.planes.back();
}

/// Adds the straight edges and the corners of a plane: two planes may show one landmark.
void KeepOutline(const FramePlane& plane, const SupposedConfig& supposed, KeyframePlane& kept) {
  for (const MeasuredPlane& edge : SupposePlanes(plane, supposed)) kept.edges.push_back(edge);
  for (const Vertex& vertex : plane.vertices_c) {
    if (!vertex.extrapolated && vertex.p_c.allFinite()) kept.vertices_c.push_back(vertex);
  }
}

}  // namespace

void KeepPlanes(const Frame& frame, const PlaneMapConfig& config,
                const SupposedConfig& supposed, Keyframe& keyframe) {
  if (keyframe.culled) return;
  const bool own = frame.index == keyframe.frame_index;
  const Pose T_kc = keyframe.T_cw * Inverse(frame.T_cw);
  const std::size_t count = std::min(frame.planes.size(), frame.plane_matches.size());
  for (std::size_t f = 0; f < count; ++f) {
    const PlaneMatch& match = frame.plane_matches[f];
    if (match.decision == PlaneDecision::kUnmatched || frame.planes[f].bad) continue;
    if (!own && !match.ShowsLandmark()) continue;
    KeyframePlane& kept = PlaneShowing(match.map_plane, keyframe);
    AddEvidence(kept.seen_c, frame.planes[f], frame, Normalised(T_kc), config.keep_information);
    const PlaneEvidence known = BestKnown(kept.seen_c);
    kept.pi_c = known.pi;
    kept.centroid_c = known.centroid;
    kept.angle_sigma_rad = known.angle_sigma_rad;
    kept.offset_sigma_m = known.offset_sigma_m;
    if (own) KeepOutline(frame.planes[f], supposed, kept);
  }
}

const MapPlane* LandmarkOf(const Map& map, const KeyframePlane& plane) {
  if (plane.map_plane == kNone || map.planes.Find(plane.map_plane) == nullptr) return nullptr;
  const MapPlane* current = map.planes.Find(CurrentPlane(map, plane.map_plane));
  return current->status == LandmarkStatus::kLandmark ? current : nullptr;
}

}  // namespace slam
