#include "eval/draw/error_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "eval/draw/contact_sheet.h"
#include "eval/draw/run_gauge.h"
#include "eval/trajectory/alignment.h"
#include "eval/trajectory/match_stamps.h"

namespace eval {
namespace {

constexpr double kMaxShown_mm = 1e9;  // 1000 km: a broken file, not an error of a camera's path

std::vector<StampMatch> MatchesOf(const Run& run, const Sequence& sequence) {
  const Trajectory& truth = *sequence.groundtruth;
  return sequence.synthetic ? MatchEqual(truth, run.trajectory)
                            : MatchNearest(truth, run.trajectory);
}

/// Fills in alignment and samples.
void Compare(const Run& run, const Sequence& sequence, const std::vector<StampMatch>& matches,
             ErrorCurve& curve) {
  const Trajectory& truth = *sequence.groundtruth;
  std::vector<Eigen::Vector3d> x_w, y_g;
  for (const StampMatch& match : matches) {
    x_w.push_back(run.trajectory[match.estimate].T_wc.t);
    y_g.push_back(truth[match.truth].T_wc.t);
  }
  const auto by_positions = AlignUmeyama(x_w, y_g);
  const auto by_poses = AlignByPoses(run.trajectory, truth, sequence.synthetic);
  if (!by_poses) {
    curve.alignment = run.trajectory.empty() ? ErrorAlignment::kNothingTracked
                                             : ErrorAlignment::kNoSharedTime;
    return;
  }
  curve.alignment = by_positions ? ErrorAlignment::kPositions : ErrorAlignment::kPoses;
  const Pose T_gw = by_positions ? by_positions->T_gw : *by_poses;
  const double first_s = sequence.frames.front().stamp_s;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const StampedPose& pose = run.trajectory[matches[i].estimate];
    const Eigen::Matrix3d turn =
        truth[matches[i].truth].T_wc.R.transpose() * by_poses->R * pose.T_wc.R;
    const ErrorSample sample{pose.stamp_s - first_s, (T_gw * x_w[i] - y_g[i]).norm() * 1e3,
                             AngleOf(turn) * 180 / std::numbers::pi};
    if (!(sample.position_mm < kMaxShown_mm) || !std::isfinite(sample.rotation_deg)) {
      curve.alignment = ErrorAlignment::kNotFinite;
      curve.samples.clear();
      return;
    }
    curve.samples.push_back(sample);
  }
  std::stable_sort(
      curve.samples.begin(), curve.samples.end(),
      [](const ErrorSample& a, const ErrorSample& b) { return a.time_s < b.time_s; });
}

/// Why a frame has no error, or nothing if it has one.
std::vector<std::optional<Gap>> GapOfFrames(const Run& run, const Sequence& sequence,
                                            const std::vector<StampMatch>& matches) {
  std::vector<double> tracked_s, compared_s;
  for (const StampedPose& pose : run.trajectory) tracked_s.push_back(pose.stamp_s);
  for (const StampMatch& match : matches) {
    compared_s.push_back(run.trajectory[match.estimate].stamp_s);
  }
  std::sort(compared_s.begin(), compared_s.end());
  const std::size_t seen = FramesSeen(run, sequence);
  std::vector<std::optional<Gap>> gaps;
  for (std::size_t i = 0; i < sequence.frames.size(); ++i) {
    const double stamp_s = sequence.frames[i].stamp_s;
    if (i >= seen) {
      gaps.emplace_back(Gap::kNotRun);
    } else if (!FindFrame(tracked_s, stamp_s, sequence.synthetic)) {
      gaps.emplace_back(Gap::kLost);
    } else if (!FindFrame(compared_s, stamp_s, sequence.synthetic)) {
      gaps.emplace_back(Gap::kNoTruth);
    } else {
      gaps.emplace_back();
    }
  }
  return gaps;
}

/// Neighbouring frames of one kind make a span, which reaches halfway to the frames beside it.
std::vector<GapSpan> Spans(const std::vector<std::optional<Gap>>& gaps,
                           const std::vector<SequenceFrame>& frames) {
  const double first_s = frames.front().stamp_s;
  const auto time = [&](std::size_t i) { return frames[i].stamp_s - first_s; };
  std::vector<GapSpan> spans;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    if (!gaps[i]) continue;
    const double from = i == 0 ? 0 : (time(i - 1) + time(i)) / 2;
    const double to = i + 1 == gaps.size() ? time(i) : (time(i) + time(i + 1)) / 2;
    if (i > 0 && gaps[i - 1] == gaps[i]) {
      spans.back().to_s = to;
      ++spans.back().frames;
    } else {
      spans.push_back({*gaps[i], from, to, 1});
    }
  }
  return spans;
}

}  // namespace

std::string Explain(ErrorAlignment alignment) {
  switch (alignment) {
    case ErrorAlignment::kPositions:
      return "after rigid alignment of the positions";
    case ErrorAlignment::kPoses:
      return "after alignment of whole poses: fewer than 3 positions, or all on a line, "
             "so the ATE is not defined";
    case ErrorAlignment::kNothingTracked:
      return "not aligned: the run tracked no frame, so there is no error to show";
    case ErrorAlignment::kNoSharedTime:
      return "not aligned: no pose of the run has the time of a true pose, so there is no "
             "error to show";
    case ErrorAlignment::kNotFinite:
      break;
  }
  return "not aligned: positions are more than 1000 km off; the trajectory or the truth is "
         "broken (`pas check` finds where)";
}

std::optional<ErrorCurve> ErrorsOverTime(const Run& run, const Sequence& sequence) {
  if (!sequence.groundtruth || sequence.frames.size() < 2) return std::nullopt;
  ErrorCurve curve;
  curve.duration_s = sequence.frames.back().stamp_s - sequence.frames.front().stamp_s;
  if (!(curve.duration_s > 0)) return std::nullopt;
  curve.frames = static_cast<int>(sequence.frames.size());
  const std::vector<StampMatch> matches = MatchesOf(run, sequence);
  Compare(run, sequence, matches, curve);
  curve.gaps = Spans(GapOfFrames(run, sequence, matches), sequence.frames);
  return curve;
}

}  // namespace eval
