#pragma once

#include "slam/pose/factors/linearised.h"
#include "slam/pose/pose_problem.h"

namespace slam {

/// Rotation vector of the shortest turn from unit n_1 to unit n_2, and its derivative by n_2.
///   r = theta / sin(theta) * (n_1 x n_2),   |r| = theta = angle(n_1, n_2)
/// These are eq16's (phi, psi) after the turn that brings n_1 to e_x, where the chart is
/// regular: written without axes of the tangent plane, because no choice of two axes is
/// continuous over the sphere. r is smooth for every n_1 and every n_2 but -n_1, where `valid`
/// is false.
struct NormalDifference {
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  Eigen::Matrix3d dr_dn2 = Eigen::Matrix3d::Zero();  ///< for n_2 moving on the sphere
  bool valid = false;
};
NormalDifference TurnBetween(const Eigen::Vector3d& n_1, const Eigen::Vector3d& n_2);

/// f_pi: the map plane as it should be seen against the plane as it is measured.
///   r = ( turn from n_c to R_cw n_w [rad],  n_p . x + d_p [m] ),   (n_p, d_p) = T_cw^{-T} pi_w
/// x is the measured patch's centroid on pi_c: the offset is taken where the plane was seen, so
/// that it depends neither on where the world's origin lies nor on a lever arm from the camera.
/// Source: PAS-SLAM eq15, eq16 (corrected: printed arctan(n_y / n_y) is atan2(n_y, n_x); both
/// normals are turned so that the measured one is phi = psi = 0, because q of the camera frame
/// is singular at the fronto-parallel plane; the offset is measured at the patch).
Linearised<4> PlaneFactor(const PlaneConstraint& constraint, const Pose& T_cw);

}  // namespace slam
