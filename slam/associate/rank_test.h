#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "slam/geometry/plane.h"

namespace slam {

/// Outcome of one Mann-Whitney test of two samples.
struct RankTest {
  double U_c = 0.0, U_w = 0.0;  ///< U_c + U_w = I J; multiples of 1/2
  double p = 1.0;               ///< two-sided, in [0, 1]
  bool exact = false;           ///< from the permutation distribution, not from the normal one
};

/// Mann-Whitney's test that two samples come from one distribution.
///
///   U_c = sum R_i^c - I (I + 1) / 2,  U_w likewise,  W = min(U_c, U_w)            eq9
///   E(W) = I J / 2                                                                eq10
///   D(W) = I J / 12 * ( I + J + 1 - sum (tau_k^3 - tau_k) / ((I + J)(I + J - 1)) )  eq11
///   z = ( W - E(W) + 1/2 ) / sqrt(D(W)),  p = 2 Phi(z), at most 1                 eq12
///
/// Ties share their mean rank. When either sample has at most 8 values the p-value is exact:
/// the share of all divisions of the pooled values that are at least as far from E(W); ties
/// included. Larger samples use the normal form with continuity correction.
/// @returns p = 1 when a sample is empty or all values are equal.
/// @throws std::invalid_argument if a value is NaN.
/// Source: PAS-SLAM eq9, eq10 (corrected: printed I(I + J + 1)/2 is the mean of the rank sum,
/// not of U), eq11, eq12 (corrected: continuity and exact small samples). Cost: O(n log n);
/// exact: O(I J (I + J) min(I, J)), with the larger sample thinned to 60.
RankTest TestRanks(std::span<const double> sample_c, std::span<const double> sample_w);

/// Tests two clouds along the two in-plane principal axes and the normal of a plane: not along
/// the world's axes, so that the outcome does not depend on how the world is turned.
/// @param axes  unit columns: two in the plane, then the normal
/// @param min_points  with three each no p-value can be under 0.1
/// @returns the smallest of the three p-values, Bonferroni-corrected: min(1, 3 p_min); nothing
/// when either sample has fewer points
std::optional<double> TestPlaneRanks(std::span<const Eigen::Vector3d> points_c,
                                     std::span<const Eigen::Vector3d> points_w,
                                     const Eigen::Matrix3d& axes, int min_points);

/// The two principal in-plane axes of a cloud and the plane's normal, as columns.
/// Where the cloud has no preferred direction any orthonormal pair is returned.
Eigen::Matrix3d PlaneAxes(const Plane& pi, std::span<const Eigen::Vector3d> points);

}  // namespace slam
