#pragma once

#include <optional>
#include <string>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"
#include "eval/trajectory/score_consistency.h"
#include "eval/trajectory/statistics.h"

namespace eval {

/// Relative errors over pairs a given time or path apart.
struct RelativeScore {
  double trans_rmse_m = 0.0;
  double rot_rmse_deg = 0.0;
  std::size_t pairs = 0;
};

/// How far a pose is off, after the alignments that the figures of all poses rest on.
struct PoseError {
  double stamp_s = 0.0;                ///< of the estimate
  std::optional<double> position_m;    ///< as in ate_se3
  std::optional<double> rotation_deg;  ///< in the world of the truth by whole poses (gauge)
  std::optional<Eigen::Vector3d> position_g;  ///< that of position_m, else by whole poses
};

/// The group `trajectory` of metrics.json; what is not defined is empty, and the text beside it
/// says why.
struct TrajectoryScore {
  std::size_t frames = 0;             ///< frames of the sequence
  std::size_t tracked = 0;            ///< those of them with a pose in the run
  std::size_t lost_events = 0;        ///< times a tracked frame is followed by one that is not
  std::optional<Statistics> ate_se3;  ///< metres
  std::optional<Statistics> ate_origin;  ///< metres, first matched pose laid on the truth
  /// Metres. Every frame with truth counts, by one pose: a frame without is charged the diameter of
  /// the true path, so that giving up frames cannot improve a run whose errors stay below that.
  std::optional<double> ate_complete_rmse_m;
  std::optional<RelativeScore> rpe_1s, rpe_1m;
  std::string no_match;              ///< why no pose has a truth; empty when some have
  std::string no_ate_se3;            ///< why ate_se3 is empty
  std::string no_ate_complete;       ///< why ate_complete_rmse_m is empty
  std::vector<bool> tracked_frames;  ///< by frame of the sequence
  std::vector<PoseError> errors;     ///< of the matched poses
  std::vector<Eigen::Vector3d> true_positions_g;  ///< of the frames that have a truth, metres
  std::optional<BetterFit> better_fit;  ///< of the matched positions: another unit, a mirror
  /// World of the run to world of the truth, by whole poses: what the map is scored in.
  std::optional<Alignment> gauge;
  /// What the run says of its own errors; nothing where it does not.
  std::optional<ConsistencyScore> consistency;
};

/// @throws InputError if the run is of another sequence, as RequireRunOf tells
TrajectoryScore ScoreTrajectory(const Run& run, const Sequence& sequence);

/// The same from bare lists. `frame_stamps_s` rise.
/// @param equal_stamps  frame ids are stamps (synthetic data); else the nearest-time rule
/// @param covariances   of the estimate's poses, by rising stamp; null: it tells none
TrajectoryScore ScoreTrajectory(const Trajectory& estimate, const Trajectory& truth,
                                const std::vector<double>& frame_stamps_s, bool equal_stamps,
                                const std::vector<PoseCovariance>* covariances = nullptr);

/// True poses T_gc of the frames, by frame; empty where the truth has none.
std::vector<std::optional<Pose>> TruePosesOfFrames(const Trajectory& truth,
                                                   const std::vector<double>& frame_stamps_s,
                                                   bool equal_stamps);

}  // namespace eval
