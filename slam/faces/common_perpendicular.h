#pragma once

#include <optional>

#include "slam/geometry/line.h"

namespace slam {

/// Feet of the common perpendicular: the closest points of two lines.
struct PerpendicularFeet {
  Eigen::Vector3d on_i, on_j;
};

/// Closest points of L_i = (P_i, V_i) and L_j = (P_j, V_j), any two lines that are not
/// parallel:
///
///   K_j  = (P_i - P_j + ((P_j - P_i) . V_i) V_i) . V_j / (V_j . V_j - (V_i . V_j)^2)     eq5
///   P_pj = P_j + K_j V_j                                                                 eq2
///   P_pi = P_i + [(P_pj - P_i) . V_i] V_i                                                eq3
///
/// @param L_i, L_j  one frame, metres; directions of any length (they are normalised)
/// @param min_angle_rad  the denominator of eq5 is sin^2 of the angle between the lines: at
///                       this angle and below there is no answer; domain (0, pi/2)
/// @returns nothing for lines nearly parallel, and where a direction is zero or not finite
///
/// Source: PAS-SLAM eq2, eq3 (corrected: the foot is a projection along V_i, the paper prints
/// P_i), eq5. Error: below 1e-14 L / sin^2(angle) for coordinates of size L.
std::optional<PerpendicularFeet> CommonPerpendicular(const Line& L_i, const Line& L_j,
                                                     double min_angle_rad);

}  // namespace slam
