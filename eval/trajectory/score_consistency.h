#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "eval/formats/run/pose_covariance.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/nees.h"

namespace eval {

/// A pose with what its system says of it, and the true one.
struct ClaimedPose {
  double stamp_s = 0.0;
  Pose T_wc, T_gc;  ///< estimate and truth
  Matrix6d covariance = Matrix6d::Zero();
};

/// Errors of one kind against their covariances: of the position (3 numbers), of the rotation
/// (3) and of both together (6).
struct ClaimScore {
  std::size_t count = 0;
  Nees position, rotation, pose;
  /// Errors of position or rotation that are in some direction beyond kSilentSigmas of the claim.
  std::size_t silent = 0;
};

/// The group `consistency` of metrics.json; what is not defined is empty, and the text beside it
/// says why.
struct ConsistencyScore {
  /// Of whole poses in the world of the truth. Holds what the run has drifted, of which a
  /// covariance that speaks of a pose in its map says nothing.
  std::optional<ClaimScore> absolute;
  std::string no_absolute;
  /// Of the motion over kClaimTime_s, as RPE takes it, which no drift from before enters. Its
  /// covariance is the sum of both poses', as if they erred independently.
  std::optional<ClaimScore> relative;
  std::string no_relative;
};

/// Scores poses that were matched with the truth, by rising stamp. An error is that of
/// T_gc = T_gw T_wc Exp(xi), to first order: the translation and the rotation vector of the
/// remaining motion, in the axes of the camera. Where a covariance is singular, as that of the pose
/// that defines the world, the error is left out.
/// @param gauge      world of the run to world of the truth, as the map is scored in it
/// @param half_frame_s  by how much a pair may miss kClaimTime_s
ConsistencyScore ScoreConsistency(const std::vector<ClaimedPose>& poses,
                                  const std::optional<Alignment>& gauge, double half_frame_s);
inline constexpr double kClaimTime_s = 1.0;

}  // namespace eval
