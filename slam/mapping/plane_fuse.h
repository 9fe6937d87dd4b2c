#pragma once

#include "slam/associate/association_config.h"
#include "slam/mapping/plane_map_config.h"
#include "slam/model/map.h"

namespace slam {

/// Fuses landmarks that are one surface: parameters agree within their uncertainty from both
/// sides, their clouds share voxels, their classes do not contradict. Two planes often seen
/// side by side with an offset between them that is beyond their uncertainty are two, and those
/// between which most of these frames showed a step; so are
/// landmarks that were split (plane_split.h), and planes that are merely in line (tops of equal
/// boxes), because their clouds do not meet. The older landmark stays, the younger gets
/// `merged_into`; chains are resolved to their end, and covisibility and points follow.
/// References to culled map points are dropped. Run at keyframes.
/// @returns the number of landmarks fused into others.
/// Source: PAS-SLAM, Local Mapping (fusion by association and covisibility).
int FusePlanes(Map& map, const AssociationConfig& association, const PlaneMapConfig& config);

}  // namespace slam
