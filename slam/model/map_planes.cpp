#include "slam/model/map_planes.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace slam {

MapPlane& MapPlanes::Add(MapPlane plane) {
  plane.id = next_id_++;
  return planes_.emplace_back(std::move(plane));
}

const MapPlane* MapPlanes::Find(int id) const {
  const auto found = std::lower_bound(planes_.begin(), planes_.end(), id,
                                      [](const MapPlane& p, int i) { return p.id < i; });
  return found == planes_.end() || found->id != id ? nullptr : &*found;
}

const MapPlane& MapPlanes::At(int id) const {
  const MapPlane* found = Find(id);
  if (found == nullptr)
    throw std::out_of_range("MapPlanes::At: no plane " + std::to_string(id));
  return *found;
}

MapPlane& MapPlanes::At(int id) {
  return const_cast<MapPlane&>(static_cast<const MapPlanes&>(*this).At(id));
}

}  // namespace slam
