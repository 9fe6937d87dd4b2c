#pragma once

#include <utility>
#include <vector>

#include "slam/model/map.h"

namespace slam {

/// Surfaces of one status, in the order of their ids.
inline std::vector<MapPlane*> SurfacesOf(Map& map, LandmarkStatus status) {
  std::vector<MapPlane*> surfaces;
  for (MapPlane& plane : map.planes) {
    if (plane.status == status) surfaces.push_back(&plane);
  }
  return surfaces;
}
inline std::vector<MapPlane*> Landmarks(Map& map) {
  return SurfacesOf(map, LandmarkStatus::kLandmark);
}
inline std::vector<MapPlane*> Candidates(Map& map) {
  return SurfacesOf(map, LandmarkStatus::kCandidate);
}

/// Puts a landmark into the map. @returns its id
inline int AddLandmark(Map& map, MapPlane plane) {
  plane.status = LandmarkStatus::kLandmark;
  return map.planes.Add(std::move(plane)).id;
}

}  // namespace slam
