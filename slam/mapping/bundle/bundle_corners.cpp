#include "slam/mapping/bundle/bundle_corners.h"

#include <algorithm>
#include <array>

#include "slam/base/index.h"
#include "slam/mapping/keyframe_planes.h"
#include "slam/model/map_queries.h"
#include "slam/pose/plane_constraints.h"

namespace slam {
namespace {

using Sightings = std::vector<BundleWindow::CornerObservation>;

/// What the window's keyframes have seen of each of the landmark's corners.
std::array<Sightings, kFaceCorners> SightingsOf(const Map& map, const MapPlane& landmark,
                                                const std::map<int, std::size_t>& pose_at) {
  std::array<Sightings, kFaceCorners> sightings;
  for (const auto& [id, at] : pose_at) {
    const Keyframe& keyframe = map.keyframes[Index(id)];
    const Pose T_wc = Inverse(keyframe.T_cw);
    for (const KeyframePlane& plane : keyframe.planes) {
      if (LandmarkOf(map, plane) != &landmark) continue;
      for (const Vertex& seen : plane.vertices_c) {
        const auto corner = NearestVertex(landmark, T_wc * seen.p_c, kMaxVertexJump_m);
        if (!corner) continue;
        sightings[*corner].push_back(
            {at, 0, true,
             std::make_unique<VertexTerm>(MakeVertexConstraint(seen, plane.pi_c, 0)), nullptr});
      }
    }
  }
  return sightings;
}

/// One keyframe alone agrees with any place of a corner, and so do fixed ones.
bool TellsOfPoses(const Sightings& sightings, std::size_t free_count) {
  const auto moves = [&](const auto& o) { return o.pose_at < free_count; };
  const auto another = [&](const auto& o) { return o.pose_at != sightings.front().pose_at; };
  return std::any_of(sightings.begin(), sightings.end(), moves) &&
         std::any_of(sightings.begin(), sightings.end(), another);
}

}  // namespace

void AddCorners(const Map& map, const MapPlane& landmark,
                const std::map<int, std::size_t>& pose_at, BundleWindow& window) {
  if (landmark.vertices_w.size() != kFaceCorners) return;
  const WindowPlane& plane = window.planes.back();
  const PlaneAxes axes(plane.start_w, plane.reference_w);
  std::array<Sightings, kFaceCorners> sightings = SightingsOf(map, landmark, pose_at);
  for (std::size_t i = 0; i < kFaceCorners; ++i) {
    if (!TellsOfPoses(sightings[i], window.free_count)) continue;
    for (BundleWindow::CornerObservation& o : sightings[i]) {
      o.corner_at = window.corners.size();
      o.in_plane = std::make_unique<InPlaneTerm<2>>(*o.term, axes);
      window.corner_observations.push_back(std::move(o));
    }
    window.corners.push_back({window.planes.size() - 1, axes});
    window.corner_blocks.push_back(axes.BlockOf(landmark.vertices_w[i]));
  }
}

}  // namespace slam
