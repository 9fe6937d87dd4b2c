#include "eval/report/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "io/input_error.h"

namespace eval {
namespace {

std::optional<TimingScore> ScoreTiming(const Run& run) {
  if (!run.timing) return std::nullopt;
  TimingScore score;
  for (std::size_t column = 0; column < run.timing->modules.size(); ++column) {
    std::vector<double> times_ms;
    for (const std::vector<double>& row : run.timing->rows_ms) {
      if (std::isfinite(row[column])) times_ms.push_back(row[column]);
    }
    const auto described = Describe(times_ms);
    if (!described) continue;
    const std::string& module = run.timing->modules[column];
    score.modules.push_back(
        {module, described->mean, described->median, Quantile(times_ms, 0.95)});
    if (module == "mt" && described->mean > 0.0) score.fps = 1000.0 / described->mean;
  }
  score.peak_rss_mb = run.info.peak_memory_mb;
  return score;
}

/// The groups that a run's planes would be scored in.
std::vector<std::string> PlaneGroupsOf(const Run& run) {
  std::vector<std::string> groups;
  if (run.has_planes) groups = {"extraction", "vertices", "association"};
  if (run.has_map) groups.emplace_back("map");
  return groups;
}

/// What is known of data whose poses agree but for a unit or a mirror. The errors are of that, then,
/// and say nothing of the run.
Fault Misfit(const BetterFit& fit) {
  const bool scaled = fit.scale != 1.0;
  const std::string how =
      scaled ? fmt::format("{}times {:.4g}", fit.mirrored ? "mirrored and " : "", fit.scale)
             : "mirrored";
  std::string mend;
  if (scaled) {
    mend = fmt::format("is depth_factor of the camera right ({:.4g} times as large would fit)",
                       1.0 / fit.scale);
  }
  if (fit.mirrored) {
    mend += scaled ? ", and" : "";
    mend += std::string(scaled ? " " : "") +
            "is the truth of a left-handed world (docs/cameras.md: ICL-NUIM)";
  }
  return {"trajectory.txt", 0, "",
          fmt::format("lies {:.3g} m rms off the truth, but {:.3g} m when it is {}",
                      fit.rigid_rmse_m, fit.rmse_m, how),
          mend + "?"};
}

/// What is no fault of the run, but has to be known beside its figures.
std::vector<Fault> Caveats(const Run& run, const Sequence& sequence,
                           const Evaluation& evaluation) {
  const std::size_t frames = sequence.frames.size();
  const std::optional<PlaneScore>& planes = evaluation.planes;
  std::vector<Fault> caveats;
  if (const auto& fit = evaluation.trajectory.better_fit) caveats.push_back(Misfit(*fit));
  if (planes && planes->from_frame_planes && run.segmentation_files.empty() &&
      !sequence.plane_id_files.empty()) {
    caveats.push_back({"segmentation", 0, "",
                       "is not there: which true plane a frame's plane shows is told by its "
                       "parameters, which errs now and then, and precision with it",
                       "write label images (pas slam --save-segmentation) for exact figures"});
  }
  if (planes && planes->map && planes->map->normals_turned) {
    caveats.push_back({"map.json", 0, "/planes",
                       "more planes lie on true ones with their normals turned round than as "
                       "they stand",
                       "write normals towards the side that was seen, with n . x + d = 0"});
  }
  if (!run.has_planes && !run.segmentation_files.empty()) {
    const auto without = std::count_if(
        sequence.frames.begin(), sequence.frames.end(), [&](const SequenceFrame& frame) {
          return !run.segmentation_files.Find(frame.stamp_s).has_value();
        });
    if (without > 0) {
      caveats.push_back({"segmentation", 0, "",
                         fmt::format("has no image for {} of {} frames", without, frames),
                         "they count as frames in which nothing was found"});
    }
  }
  if (run.info.interrupted) {
    const std::string given = run.info.frames ? fmt::format("{}", *run.info.frames) : "some";
    const auto whole = run.info.sequence_frames.value_or(static_cast<int>(frames));
    caveats.push_back(
        {"run.json", 0, "/interrupted",
         fmt::format("the run was interrupted after {} of {} frames", given, whole),
         "frames after that count as lost"});
  } else if (run.info.frames && *run.info.frames != static_cast<int>(frames)) {
    caveats.push_back({"run.json", 0, "/frames",
                       fmt::format("the run was given {} frames, the sequence has {}",
                                   *run.info.frames, frames),
                       "figures are over those of the sequence"});
  }
  const auto has_frame = [&, stamps_s = StampsOf(sequence.frames)](const StampedPose& pose) {
    return NearestStamp(stamps_s, pose.stamp_s, kMaxStampDifference_s).has_value();
  };
  for (const StampedPose& pose : run.trajectory) {
    if (has_frame(pose)) continue;
    caveats.push_back({"trajectory.txt", pose.line, "",
                       fmt::format("the pose at {:.6f} s belongs to no frame", pose.stamp_s),
                       "score a run against the sequence it was made from"});
  }
  return caveats;
}

}  // namespace

Evaluation Evaluate(const Run& run, const Sequence& sequence) {
  Evaluation evaluation;
  evaluation.trajectory = ScoreTrajectory(run, sequence);
  evaluation.planes = ScorePlanes(run, sequence, evaluation.trajectory);
  evaluation.timing = ScoreTiming(run);
  evaluation.interrupted = run.info.interrupted;
  evaluation.run_warnings = run.warnings;
  for (Fault& caveat : Caveats(run, sequence, evaluation)) {
    evaluation.run_warnings.push_back(std::move(caveat));
  }
  evaluation.sequence_warnings = sequence.warnings;
  evaluation.no_planes = WhyNoPlaneScore(sequence);
  if (!evaluation.no_planes.empty()) {
    evaluation.groups_without_truth = PlaneGroupsOf(run);
    evaluation.sequence_warnings.push_back({"gt", 0, "",
                                            "has neither plane_id/ images nor frames.jsonl: no "
                                            "planes are scored, as nothing tells "
                                            "which ones a frame shows",
                                            "write one of them, or remove scene.json"});
  }
  return evaluation;
}

LabelEvaluation EvaluateLabels(const Run& labels, const Sequence& sequence) {
  if (!sequence.scene || !sequence.groundtruth || sequence.plane_id_files.empty()) {
    throw io::InputError(sequence.folder.string(),
                         "does not tell which planes its pixels show: gt/scene.json, "
                         "gt/plane_id/ and groundtruth.txt are needed; name a sequence of "
                         "`pas sim`");
  }
  std::size_t missing = 0;
  for (const SequenceFrame& frame : sequence.frames) {
    if (!labels.segmentation_files.Find(frame.stamp_s)) ++missing;
  }
  if (missing == sequence.frames.size()) {
    throw io::InputError(labels.folder.string(),
                         "has no image of any frame of " + sequence.folder.string() +
                             "; name images by the times of rgb.txt, as 1.033333.png");
  }
  LabelEvaluation evaluation;
  if (missing > 0) {
    evaluation.label_warnings.push_back(
        {".", 0, "",
         fmt::format("has no image of {} of {} frames", missing, sequence.frames.size()),
         "nothing counts as found in them"});
  }
  evaluation.planes = ScorePlanes(labels, sequence, {}).value();
  evaluation.sequence_warnings = sequence.warnings;
  return evaluation;
}

}  // namespace eval
