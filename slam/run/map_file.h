#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "slam/model/map.h"

namespace slam {

/// map.json (formats.md), a plane a line: every plane ever made, those merged into others
/// included. World frame.
std::string MapAsJson(const Map& map);

/// map.ply: the points of the planes that stand for themselves (not merged), ASCII PLY with
/// x y z (metres, world), red green blue, and int plane_id.
std::string MapAsPly(const Map& map);

/// Colour of a plane id, RGB: neighbouring ids differ clearly, the same id never changes.
std::array<std::uint8_t, 3> PlaneColour(int id);

}  // namespace slam
