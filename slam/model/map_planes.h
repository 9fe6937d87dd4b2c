#pragma once

#include <cstddef>
#include <vector>

#include "slam/model/map_plane.h"

namespace slam {

/// The surfaces of a map in the order in which they were first seen. An id says which, for
/// good: it is never given again, and a candidate that failed its trial leaves a gap.
class MapPlanes {
 public:
  /// Takes a surface in and gives it the next id. @returns it, until another comes or goes
  MapPlane& Add(MapPlane plane);

  /// @returns null for an id that is not there
  const MapPlane* Find(int id) const;
  /// @throws std::out_of_range for an id that is not there.
  MapPlane& At(int id);
  const MapPlane& At(int id) const;

  /// Takes candidates out for which `fails(plane)` is true; landmarks stay whatever it says.
  template <typename Predicate>
  void EraseCandidates(const Predicate& fails) {
    std::erase_if(planes_, [&](const MapPlane& plane) {
      return plane.status == LandmarkStatus::kCandidate && fails(plane);
    });
  }

  auto begin() { return planes_.begin(); }
  auto end() { return planes_.end(); }
  auto begin() const { return planes_.begin(); }
  auto end() const { return planes_.end(); }
  std::size_t size() const { return planes_.size(); }
  bool empty() const { return planes_.empty(); }

 private:
  std::vector<MapPlane> planes_;  ///< ids rise
  int next_id_ = 0;
};

}  // namespace slam
