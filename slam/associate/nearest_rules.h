#pragma once

#include "slam/associate/association_config.h"
#include "slam/associate/refusals.h"
#include "slam/base/result.h"
#include "slam/model/frame.h"
#include "slam/model/map_plane.h"

namespace slam {

/// The rules of common systems, which ask two planes alone and not the others of frame and map:
/// a pair passes bounds on its parameters, and of the landmarks that pass the nearest is taken.
///
/// kParameters asks eq6 and (eq7 or eq8). The others are what the peers' programs do, by their
/// bounds: the angle of the normals, and the least distance that a point of the landmark has from
/// the frame plane. The points are the landmark's cloud, for SP-SLAM those of its outline.
///
///   |            | normals                      | nearest point |
///   | ---------- | ---------------------------- | ------------- |
///   | Manhattan  | cosine > 0.985 (10 degrees)  | < 0.05 m      |
///   | Planar     | abs(cosine) > 0.86 (31)      | < 0.1 m       |
///   | SP         | abs(cosine) > 0.8 (37)       | < 0.2 m       |
///
/// @param plane  of a frame at T_cw
/// @param m      a plane of the map with its cloud
/// @param rule   any but kIntegrated
/// @returns the distance of the pair by the rule, metres, or what refused it
///
/// Source: ManhattanSLAM (8b29a705), PlanarSLAM (08b5719e) and SP-SLAM (dabf4a4e) as their sources
/// have it, which differs from the papers in places. Cost: O(points of the landmark).
[[nodiscard]] Result<double, PairRefusal> TestNearness(const FramePlane& plane,
                                                       const MapPlane& m, const Pose& T_cw,
                                                       AssociationRule rule,
                                                       const PlaneGateConfig& gates);

}  // namespace slam
