#include "eval/trajectory/compare_trajectories.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "eval/trajectory/match_stamps.h"
#include "eval/trajectory/pose_errors.h"
#include "io/input_error.h"

namespace eval {
namespace {

// Share of metres and degrees by which a pair may miss (evo).
constexpr double kDeltaTolerance = 0.1;

struct MatchedFiles {
  std::vector<double> stamps_s;  ///< of the estimate
  std::vector<Pose> estimate, truth;
};

void RequireSameClock(const PoseFile& estimate, const PoseFile& truth) {
  const bool counted = estimate.kind == PoseFileKind::kKitti;
  if (counted != (truth.kind == PoseFileKind::kKitti)) {
    throw io::InputError(
        estimate.path.string(),
        fmt::format("is a {} file, the truth {} is a {} file, and KITTI's have no times; "
                    "write both with times or both without",
                    NameOf(estimate.kind), truth.path.string(), NameOf(truth.kind)));
  }
  if (counted && estimate.poses.size() != truth.poses.size()) {
    throw io::InputError(
        estimate.path.string(),
        fmt::format("has {} poses, the truth {} has {}; KITTI files have no "
                    "times, so they must have a line for each frame",
                    estimate.poses.size(), truth.path.string(), truth.poses.size()));
  }
}

void RequireTimes(const PoseFile& estimate, const ComparisonRules& rules) {
  if (estimate.kind != PoseFileKind::kKitti || rules.delta.unit != DeltaUnit::kSeconds) return;
  throw io::InputError("--delta",
                       "is in seconds, and KITTI files have no times; ask for frames "
                       "(1f), metres (1m) or degrees (10deg)");
}

MatchedFiles MatchFiles(const PoseFile& estimate, const PoseFile& truth,
                        double max_difference_s) {
  RequireSameClock(estimate, truth);
  MatchedFiles matched;
  for (const StampMatch& m : MatchNearest(truth.poses, estimate.poses, max_difference_s)) {
    matched.stamps_s.push_back(estimate.poses[m.estimate].stamp_s);
    matched.estimate.push_back(estimate.poses[m.estimate].T_wc);
    matched.truth.push_back(truth.poses[m.truth].T_wc);
  }
  if (matched.truth.size() >= 2) return matched;
  throw io::InputError(
      estimate.path.string(),
      fmt::format("{} of its {} poses ({:.3f} to {:.3f} s) {} a true pose within {:g} s in {} "
                  "({:.3f} to {:.3f} s); name the truth of the same recording, or a larger "
                  "--max-dt",
                  matched.truth.empty() ? "none" : "only one", estimate.poses.size(),
                  estimate.poses.front().stamp_s, estimate.poses.back().stamp_s,
                  matched.truth.empty() ? "have" : "has", max_difference_s, truth.path.string(),
                  truth.poses.front().stamp_s, truth.poses.back().stamp_s));
}

std::optional<Alignment> Aligned(const MatchedFiles& matched, AlignMode mode) {
  switch (mode) {
    case AlignMode::kNone:
      return Alignment{};
    case AlignMode::kOrigin:
      return AlignOrigin(matched.estimate.front(), matched.truth.front());
    case AlignMode::kSe3:
    case AlignMode::kSim3:
      break;
  }
  return AlignUmeyama(PositionsOf(matched.estimate), PositionsOf(matched.truth),
                      mode == AlignMode::kSim3);
}

std::vector<PosePair> PairsOf(const MatchedFiles& matched, const std::vector<Pose>& poses,
                              const ComparisonRules& rules) {
  const double delta = rules.delta.value, tolerance = kDeltaTolerance * delta;
  constexpr double kDegree_rad = std::numbers::pi / 180.0;
  switch (rules.delta.unit) {
    case DeltaUnit::kMetres:
      return PairsByPath(poses, delta, tolerance, rules.pairs);
    case DeltaUnit::kDegrees:
      return PairsByAngle(poses, delta * kDegree_rad, tolerance * kDegree_rad, rules.pairs);
    case DeltaUnit::kSeconds:  // within half a frame, as evaluation of runs does
      return PairsByTime(matched.stamps_s, delta, 0.5 * MedianStep(matched.stamps_s),
                         rules.pairs);
    case DeltaUnit::kFrames:
      break;
  }
  return PairsByFrames(poses.size(), static_cast<std::size_t>(delta), rules.pairs);
}

double PathLength(const std::vector<Pose>& poses) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    length_m += (poses[i].t - poses[i - 1].t).norm();
  }
  return length_m;
}

double LongestGap(const std::vector<double>& stamps_s) {
  double longest_s = 0.0;
  for (std::size_t i = 1; i < stamps_s.size(); ++i) {
    longest_s = std::max(longest_s, stamps_s[i] - stamps_s[i - 1]);
  }
  return longest_s;
}

template <typename ErrorsIn>
ErrorStatistics StatisticsOf(const ErrorsIn& errors_in) {
  return {Describe(errors_in(Relation::kTranslation)), Describe(errors_in(Relation::kAngleDeg)),
          Describe(errors_in(Relation::kFull))};
}

void ScoreAligned(const MatchedFiles& matched, const Alignment& alignment,
                  const ComparisonRules& rules, TrajectoryComparison& score) {
  score.scale = alignment.scale;
  std::vector<Pose> estimate = Apply(alignment, matched.estimate), truth = matched.truth;
  for (Pose& pose : estimate) pose = Project(pose, rules.plane);
  for (Pose& pose : truth) pose = Project(pose, rules.plane);
  score.absolute = StatisticsOf(
      [&](Relation relation) { return AbsoluteErrors(estimate, truth, relation); });
  const std::vector<PosePair> pairs =
      PairsOf(matched, rules.pairs_from_truth ? truth : estimate, rules);
  score.pairs = pairs.size();
  score.relative = StatisticsOf(
      [&](Relation relation) { return RelativeErrors(estimate, truth, pairs, relation); });
  if (pairs.empty()) score.no_relative = "no two matched poses are that far apart";
}

}  // namespace

TrajectoryComparison CompareTrajectories(const PoseFile& estimate, const PoseFile& truth,
                                         const ComparisonRules& rules) {
  RequireTimes(estimate, rules);
  const MatchedFiles matched = MatchFiles(estimate, truth, rules.max_difference_s);
  TrajectoryComparison score;
  score.poses = estimate.poses.size();
  score.true_poses = truth.poses.size();
  score.matched = matched.truth.size();
  score.path_m = PathLength(matched.estimate);
  score.true_path_m = PathLength(matched.truth);
  score.max_gap_s = LongestGap(matched.stamps_s);
  if (const auto alignment = Aligned(matched, rules.align)) {
    ScoreAligned(matched, *alignment, rules, score);
    return score;
  }
  const auto reason = WhyNotAligned(PositionsOf(matched.estimate), PositionsOf(matched.truth));
  // No rigid motion changes relative errors in space.
  if (rules.align == AlignMode::kSe3 && rules.plane == ProjectionPlane::kNone) {
    ScoreAligned(matched, {}, rules, score);
  }
  score.no_absolute = TextOf(reason.value(), "matched positions", score.matched);
  score.absolute = {};
  if (!score.relative.translation_m && score.no_relative.empty()) {
    score.no_relative = score.no_absolute;
  }
  return score;
}

Pose Project(const Pose& pose, ProjectionPlane plane) {
  if (plane == ProjectionPlane::kNone) return pose;
  const Eigen::Matrix3d& R = pose.R;
  int across = 2;
  double angle_rad = std::atan2(R(1, 0), R(0, 0));
  if (plane == ProjectionPlane::kXz) {
    across = 1;
    angle_rad = std::atan2(-R(2, 0), std::hypot(R(0, 0), R(1, 0)));
  } else if (plane == ProjectionPlane::kYz) {
    across = 0;
    angle_rad = std::atan2(R(2, 1), R(2, 2));
  }
  Pose flat = pose;
  flat.t[across] = 0.0;
  flat.R = Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::Unit(across)).toRotationMatrix();
  return flat;
}

}  // namespace eval
