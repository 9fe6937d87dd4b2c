#pragma once

#include <optional>
#include <string>
#include <vector>

#include "eval/formats/pose/pose.h"

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

/// Why positions of equal count have no alignment.
enum class NoAlignment { kFewPoses, kStandsStill, kLine };
/// @returns nothing where AlignUmeyama gives one
std::optional<NoAlignment> WhyNotAligned(const std::vector<Eigen::Vector3d>& x_w,
                                         const std::vector<Eigen::Vector3d>& y_g);
/// The reason in words: "only 2 matched positions, 3 are needed".
/// @param what  stands for the positions, of which there are `count`
std::string TextOf(NoAlignment reason, const std::string& what, std::size_t count);

/// The rigid motion that lays whole poses on the truth, from rotations and positions alike:
///   R = argmin sum |R_gc - R R_wc|^2 (the chordal mean of R_gc R_wc^T),  t = my - R mx.
/// Unlike an alignment of positions alone it holds for one pose, and on short and straight paths,
/// and it does not tilt a map to please the path.
/// @param T_wc, T_gc  poses of equal count, matched one by one
/// @returns nothing ("not defined") without poses, and where the rotations contradict each other
///          so that no mean is nearest
std::optional<Alignment> AlignByPoses(const std::vector<Pose>& T_wc,
                                      const std::vector<Pose>& T_gc);

/// What would lay the positions on the truth where a rigid motion does not: another unit, or a
/// mirror, as between a left-handed world and a right-handed one.
struct BetterFit {
  double scale = 1.0;  ///< of the estimate, about; 1 where the unit is right
  bool mirrored = false;
  double rigid_rmse_m = 0.0, rmse_m = 0.0;  ///< as they are, and so
};
/// @returns nothing where there is no alignment, where a rigid motion fits as well as can be
///          expected, and where neither is far better
std::optional<BetterFit> FindBetterFit(const std::vector<Eigen::Vector3d>& x_w,
                                       const std::vector<Eigen::Vector3d>& y_g);

std::vector<Eigen::Vector3d> PositionsOf(const std::vector<Pose>& poses);
std::vector<Pose> Apply(const Alignment& alignment, const std::vector<Pose>& poses);

/// The motion that lays the first pose of the estimate on that of the truth.
Alignment AlignOrigin(const Pose& first_T_wc, const Pose& first_T_gc);

}  // namespace eval
