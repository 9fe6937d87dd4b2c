#pragma once

#include <vector>

#include "eval/formats/plane.h"
#include "eval/surfaces/surfel_cloud.h"

namespace eval {

/// Surfels that lie on one plane, wherever they are on it.
struct PlanePatch {
  Plane pi_g;  ///< normal towards the cameras
  std::vector<Surfel> surfels;
};

/// Planes of a cloud by region growing from its flattest places, each with tolerances that
/// follow the distance at which it was seen; patches that are one plane are then joined,
/// adjacent or not.
/// @param min_area_m2  smaller patches are dropped before they are joined to others
std::vector<PlanePatch> GrowPlanes(const std::vector<Surfel>& surfels, double min_area_m2);

}  // namespace eval
