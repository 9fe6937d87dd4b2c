#include "eval/trajectory/score_trajectory.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eval/formats/run/run_agreement.h"
#include "eval/trajectory/pose_errors.h"

namespace eval {
namespace {

constexpr double kRpeTime_s = 1.0;
constexpr double kRpePath_m = 1.0;
constexpr double kRpePathTolerance_m = 0.1 * kRpePath_m;

struct MatchedPoses {
  std::vector<double> stamps_s;
  std::vector<Pose> estimate, truth;
};

std::vector<StampMatch> Match(const Trajectory& truth, const Trajectory& estimate, bool equal) {
  return equal ? MatchEqual(truth, estimate) : MatchNearest(truth, estimate);
}

Trajectory ByRisingStamp(Trajectory trajectory) {
  std::stable_sort(
      trajectory.begin(), trajectory.end(),
      [](const StampedPose& a, const StampedPose& b) { return a.stamp_s < b.stamp_s; });
  return trajectory;
}

double Diameter(const std::vector<Eigen::Vector3d>& points) {
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      largest = std::max(largest, (points[i] - points[j]).squaredNorm());
    }
  }
  return std::sqrt(largest);
}

void CountFrames(const Trajectory& estimate, const std::vector<double>& frame_stamps_s,
                 bool equal, TrajectoryScore& score) {
  const double tolerance_s = equal ? kSameStamp_s : kMaxStampDifference_s;
  score.frames = frame_stamps_s.size();
  bool was_tracked = false;
  for (const double stamp_s : frame_stamps_s) {
    const auto next =
        std::lower_bound(estimate.begin(), estimate.end(), stamp_s - tolerance_s,
                         [](const StampedPose& pose, double s) { return pose.stamp_s < s; });
    const bool tracked = next != estimate.end() && next->stamp_s <= stamp_s + tolerance_s;
    score.tracked_frames.push_back(tracked);
    if (tracked) ++score.tracked;
    if (was_tracked && !tracked) ++score.lost_events;
    was_tracked = tracked;
  }
}

std::optional<RelativeScore> ScorePairs(const MatchedPoses& poses,
                                        const std::vector<PosePair>& pairs) {
  const auto translation =
      Describe(RelativeErrors(poses.estimate, poses.truth, pairs, Relation::kTranslation));
  const auto angle =
      Describe(RelativeErrors(poses.estimate, poses.truth, pairs, Relation::kAngleDeg));
  if (!translation) return std::nullopt;
  return RelativeScore{translation->rmse, angle->rmse, pairs.size()};
}

std::string WhyNoMatch(const Trajectory& estimate, const Trajectory& truth) {
  if (truth.empty()) return "the sequence has no groundtruth.txt";
  if (estimate.empty()) return "the run has no pose";
  return "no pose of the run has a true pose of its time";
}

MatchedPoses Collect(const Trajectory& estimate, const Trajectory& truth, bool equal) {
  MatchedPoses poses;
  for (const StampMatch& match : Match(truth, estimate, equal)) {
    poses.stamps_s.push_back(estimate[match.estimate].stamp_s);
    poses.estimate.push_back(estimate[match.estimate].T_wc);
    poses.truth.push_back(truth[match.truth].T_wc);
  }
  return poses;
}

/// @param se3    the alignment of positions, where one is defined
/// @param gauge  by whole poses
std::vector<PoseError> ErrorsOfPoses(const MatchedPoses& poses,
                                     const std::optional<Alignment>& se3,
                                     const std::optional<Alignment>& gauge) {
  std::vector<PoseError> errors;
  errors.reserve(poses.stamps_s.size());
  for (std::size_t i = 0; i < poses.stamps_s.size(); ++i) {
    const Pose &estimate = poses.estimate[i], &truth = poses.truth[i];
    PoseError error;
    error.stamp_s = poses.stamps_s[i];
    if (gauge) {
      const Pose T_gc = *gauge * estimate;
      error.rotation_deg = AngleOf(T_gc.R.transpose() * truth.R) * 180.0 / std::numbers::pi;
      error.position_g = T_gc.t;
    }
    if (se3) {
      error.position_g = (*se3 * estimate).t;
      error.position_m = (*error.position_g - truth.t).norm();
    }
    errors.push_back(error);
  }
  return errors;
}

/// The error of each frame that a pose answers for: the nearest pose, one for one frame only, so that
/// a run with more poses than frames (an IMU's) is asked for each frame all the same.
std::vector<std::optional<double>> ErrorsOfFrames(const std::vector<PoseError>& errors,
                                                  const std::vector<double>& frame_stamps_s,
                                                  bool equal) {
  const double tolerance_s = equal ? kSameStamp_s : kMaxStampDifference_s;
  const std::vector<double> stamps_s = StampsOf(errors);
  std::vector<std::optional<double>> of_frames(frame_stamps_s.size());
  for (std::size_t i = 0; i < frame_stamps_s.size(); ++i) {
    const auto pose = NearestStamp(stamps_s, frame_stamps_s[i], tolerance_s);
    if (pose && NearestStamp(frame_stamps_s, stamps_s[*pose], tolerance_s) == i) {
      of_frames[i] = errors[*pose].position_m;
    }
  }
  return of_frames;
}

/// Charges the frames that the run does not answer for; nothing where the truth itself has no
/// alignment (a camera on a tripod or on a rail).
/// @param errors  of the frames with truth
std::optional<double> CompleteRmse(const std::vector<Eigen::Vector3d>& true_positions,
                                   const std::vector<std::optional<double>>& errors) {
  if (!AlignUmeyama(true_positions, true_positions)) return std::nullopt;
  const double charge_m = Diameter(true_positions);
  double sse = 0.0, missing = 0.0;
  for (const auto& error : errors) {
    if (error) {
      sse += *error * *error;
    } else {
      missing += 1.0;
    }
  }
  return std::sqrt((sse + missing * charge_m * charge_m) / static_cast<double>(errors.size()));
}

/// The matched poses of which the run says what they are worth.
std::vector<ClaimedPose> ClaimedPoses(const MatchedPoses& poses,
                                      const std::vector<PoseCovariance>& covariances) {
  const std::vector<double> stamps_s = StampsOf(covariances);
  std::vector<ClaimedPose> claimed;
  for (std::size_t i = 0; i < poses.stamps_s.size(); ++i) {
    const auto at = NearestStamp(stamps_s, poses.stamps_s[i], kSameInstant_s);
    if (!at) continue;
    claimed.push_back(
        {poses.stamps_s[i], poses.estimate[i], poses.truth[i], covariances[*at].of_xi});
  }
  return claimed;
}

}  // namespace

std::vector<std::optional<Pose>> TruePosesOfFrames(const Trajectory& truth,
                                                   const std::vector<double>& frame_stamps_s,
                                                   bool equal_stamps) {
  Trajectory frames;
  for (const double stamp_s : frame_stamps_s) frames.push_back({stamp_s, {}});
  std::vector<std::optional<Pose>> poses(frames.size());
  const Trajectory sorted = ByRisingStamp(truth);
  for (const StampMatch& match : Match(sorted, frames, equal_stamps)) {
    poses[match.estimate] = sorted[match.truth].T_wc;
  }
  return poses;
}

TrajectoryScore ScoreTrajectory(const Trajectory& estimate, const Trajectory& unsorted_truth,
                                const std::vector<double>& frame_stamps_s, bool equal_stamps,
                                const std::vector<PoseCovariance>* covariances) {
  TrajectoryScore score;
  CountFrames(estimate, frame_stamps_s, equal_stamps, score);
  const Trajectory truth = ByRisingStamp(unsorted_truth);
  const MatchedPoses poses = Collect(estimate, truth, equal_stamps);

  if (!poses.truth.empty()) {
    const Alignment origin = AlignOrigin(poses.estimate.front(), poses.truth.front());
    score.ate_origin = Describe(
        AbsoluteErrors(Apply(origin, poses.estimate), poses.truth, Relation::kTranslation));
  }
  const auto se3 = AlignUmeyama(PositionsOf(poses.estimate), PositionsOf(poses.truth));
  if (se3) {
    score.ate_se3 = Describe(
        AbsoluteErrors(Apply(*se3, poses.estimate), poses.truth, Relation::kTranslation));
  }
  if (poses.truth.empty()) score.no_match = WhyNoMatch(estimate, truth);
  if (const auto reason =
          WhyNotAligned(PositionsOf(poses.estimate), PositionsOf(poses.truth))) {
    score.no_ate_se3 = poses.truth.empty()
                           ? score.no_match
                           : TextOf(*reason, "matched positions", poses.truth.size());
  }

  score.better_fit = FindBetterFit(PositionsOf(poses.estimate), PositionsOf(poses.truth));
  score.gauge = AlignByPoses(poses.estimate, poses.truth);
  score.errors = ErrorsOfPoses(poses, se3, score.gauge);

  const auto true_poses = TruePosesOfFrames(truth, frame_stamps_s, equal_stamps);
  const auto errors = ErrorsOfFrames(score.errors, frame_stamps_s, equal_stamps);
  std::vector<Eigen::Vector3d> true_positions;
  std::vector<std::optional<double>> frame_errors;
  for (std::size_t i = 0; i < true_poses.size(); ++i) {
    if (!true_poses[i]) continue;
    true_positions.push_back(true_poses[i]->t);
    frame_errors.push_back(errors[i]);
  }
  if (const auto reason = WhyNotAligned(true_positions, true_positions)) {
    score.no_ate_complete =
        truth.empty() ? score.no_match
                      : TextOf(*reason, "true positions of frames", true_positions.size());
  }
  score.ate_complete_rmse_m = CompleteRmse(true_positions, frame_errors);
  score.true_positions_g = std::move(true_positions);
  const double half_frame_s = 0.5 * MedianStep(frame_stamps_s);
  score.rpe_1s = ScorePairs(poses, PairsByTime(poses.stamps_s, kRpeTime_s, half_frame_s));
  score.rpe_1m = ScorePairs(
      poses, PairsByPath(poses.truth, kRpePath_m, kRpePathTolerance_m, PairMode::kAll));
  if (covariances != nullptr) {
    score.consistency =
        ScoreConsistency(ClaimedPoses(poses, *covariances), score.gauge, half_frame_s);
  }
  return score;
}

TrajectoryScore ScoreTrajectory(const Run& run, const Sequence& sequence) {
  std::vector<double> frame_stamps_s;
  for (const SequenceFrame& frame : sequence.frames) frame_stamps_s.push_back(frame.stamp_s);
  RequireRunOf(sequence, run);
  return ScoreTrajectory(run.trajectory, sequence.groundtruth.value_or(Trajectory{}),
                         frame_stamps_s, sequence.synthetic,
                         run.covariances ? &*run.covariances : nullptr);
}

}  // namespace eval
