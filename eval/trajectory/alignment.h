#pragma once

#include <optional>
#include <vector>

#include "eval/formats/pose.h"

namespace eval {

/// x_g = scale R x_w + t.
struct Alignment {
  double scale = 1.0;
  Pose T_gw;

  /// The estimate's pose in the frame of the truth: positions scaled first.
  Pose operator*(const Pose& T_wc) const { return T_gw * Pose{T_wc.R, scale * T_wc.t}; }
};

/// Below this ratio of the second to the first singular value of the covariance the positions
/// lie on a line to working precision, and the rotation about it is arbitrary.
inline constexpr double kMinSingularRatio = 1e-10;

/// Least-squares alignment of positions (Umeyama 1991, eq. 38-43):
///   Sigma = 1/n sum (y - my)(x - mx)^T = U D V^T,  R = U S V^T,  S = diag(1, 1, det U det V),
///   c = tr(D S) / var(x) with scale, else 1,  t = my - c R mx.
/// Mirrored data give a proper rotation and a large residual.
/// @param x_w, y_g  positions of equal count, metres
/// @returns nothing ("not defined") for fewer than 3 points, and where either list lies on a
///          line or stands still to working precision
std::optional<Alignment> AlignUmeyama(const std::vector<Eigen::Vector3d>& x_w,
                                      const std::vector<Eigen::Vector3d>& y_g,
                                      bool with_scale = false);

/// The motion that lays the first pose of the estimate on that of the truth.
Alignment AlignOrigin(const Pose& first_T_wc, const Pose& first_T_gc);

}  // namespace eval
