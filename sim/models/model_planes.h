#pragma once

#include "sim/models/model.h"

namespace sim {

/// Finds the flat parts of a model whose vertices and triangles are there, and sets planes and
/// plane_of. From the largest triangle that is left, neighbours across edges are added as long
/// as all corners lie within options.flatness_m of the plane, which is fitted again meanwhile.
/// No plane: less than options.min_plane_m2, or a facet of something round, which is one that
/// goes on within 15 degrees over half of its rim. Outlines lose corners that lie within 0.05
/// mm of the line between those that stay.
void FindPlanes(Model& model);

/// Takes the declared outlines (options.declared) instead: triangles in their plane, within
/// options.flatness_m, whose middle is inside.
/// @returns the index of the first outline without a triangle, -1 when there is none
int TakeDeclaredPlanes(Model& model);

}  // namespace sim
