#pragma once

#include "tests/support/plane_world.h"

namespace slam {

/// The corner of a room, 4 m wide, with three boxes on its floor, each an object of its own from 3 on.
/// @param moved_m  the boxes stand elsewhere by as much
inline PlaneWorld FurnishedRoom(double moved_m = 0.0) {
  PlaneWorld world;
  world.Add({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, "");  // floor, z up
  world.Add({0, 2, 1}, {2, 0, 0}, {0, 0, 1}, "");
  world.Add({2, 0, 1}, {0, 0, 1}, {0, 2, 0}, "");
  world.AddBox({0.5 + moved_m, 1.2, 0}, {0.4, 0.3, 0.5}, 0.0, "");
  world.AddBox({-0.4, 0.9 - moved_m, 0}, {0.3, 0.3, 0.25}, 0.0, "");
  world.AddBox({1.2, 0.4 + moved_m, 0}, {0.5, 0.4, 0.7}, 0.0, "");
  return world;
}

}  // namespace slam
