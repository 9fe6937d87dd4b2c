#include "eval/report/trajectory_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "eval/report/figure_group.h"
#include "io/number_text.h"

namespace eval {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson AllOf(const Statistics& s) {
  return {{"rmse", s.rmse}, {"mean", s.mean}, {"median", s.median}, {"std", s.std_dev},
          {"min", s.min},   {"max", s.max},   {"sse", s.sse}};
}

void PutErrors(const ErrorStatistics& errors, const std::string& reason, FigureGroup& group) {
  const auto put = [&](const char* key, const std::optional<Statistics>& figures) {
    if (!figures) return group.Undefined(key, reason);
    group.Put(key, AllOf(*figures));
  };
  put("trans_m", errors.translation_m);
  put("rot_deg", errors.rotation_deg);
  put("full", errors.full);
}

OrderedJson OneTrajectory(const ComparedTrajectory& one) {
  const TrajectoryComparison& s = one.score;
  OrderedJson reasons = OrderedJson::object();
  FigureGroup ape("ape", reasons), rpe("rpe", reasons);
  PutErrors(s.absolute, s.no_absolute, ape);
  PutErrors(s.relative, s.no_relative, rpe);
  rpe.Put("pairs", s.pairs);
  OrderedJson json{{"file", one.file},
                   {"kind", NameOf(one.kind)},
                   {"poses", s.poses},
                   {"true_poses", s.true_poses},
                   {"matched", s.matched},
                   {"path_m", s.path_m},
                   {"true_path_m", s.true_path_m}};
  if (one.kind == PoseFileKind::kKitti) {
    json["longest_gap_s"] = nullptr;
    reasons["longest_gap_s"] = "KITTI files have no times";
  } else {
    json["longest_gap_s"] = s.max_gap_s;
  }
  json["scale"] = s.no_absolute.empty() ? OrderedJson(s.scale) : OrderedJson(nullptr);
  if (!s.no_absolute.empty()) reasons["scale"] = s.no_absolute;
  json["ape"] = ape.json();
  json["rpe"] = rpe.json();
  if (!reasons.empty()) json["reasons"] = reasons;
  return json;
}

std::string Figure(const std::optional<Statistics>& figures, double Statistics::*which,
                   const char* format) {
  if (!figures) return "-";
  return fmt::format(fmt::runtime(format), (*figures).*which);
}

std::vector<std::string> Row(const ComparedTrajectory& one) {
  const TrajectoryComparison& s = one.score;
  const auto &translation = s.absolute.translation_m, &moved = s.relative.translation_m;
  return {one.file,
          fmt::format("{}/{}", s.matched, s.poses),
          Figure(translation, &Statistics::rmse, "{:.6f}"),
          Figure(translation, &Statistics::mean, "{:.6f}"),
          Figure(translation, &Statistics::median, "{:.6f}"),
          Figure(translation, &Statistics::std_dev, "{:.6f}"),
          Figure(translation, &Statistics::max, "{:.6f}"),
          Figure(s.absolute.rotation_deg, &Statistics::rmse, "{:.4f}"),
          Figure(moved, &Statistics::rmse, "{:.6f}"),
          Figure(s.relative.rotation_deg, &Statistics::rmse, "{:.4f}"),
          fmt::format("{}", s.pairs),
          s.no_absolute.empty() ? fmt::format("{:.4f}", s.scale) : "-"};
}

/// The first column to the left, numbers to the right.
std::string Columns(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    text += fmt::format("{:<{}}", row[0], widths[0]);
    for (std::size_t i = 1; i < row.size(); ++i) {
      text += fmt::format("  {:>{}}", row[i], widths[i]);
    }
    text += '\n';
  }
  return text;
}

std::string PairsText(const ComparisonRules& rules) {
  return std::string(rules.pairs == PairMode::kAll ? "all" : "consecutive") + " pairs" +
         (rules.pairs_from_truth ? " of the truth" : "");
}

}  // namespace

nlohmann::ordered_json TrajectoriesJson(const std::vector<ComparedTrajectory>& compared,
                                        const std::string& truth,
                                        const ComparisonRules& rules) {
  OrderedJson json;
  json["format"] = "pas-trajectories/1";
  json["truth"] = truth;
  json["align"] = NameOf(rules.align);
  json["max_dt_s"] = rules.max_difference_s;
  json["delta"] = TextOf(rules.delta);
  json["pairs"] = rules.pairs == PairMode::kAll ? "all" : "consecutive";
  json["pairs_from_truth"] = rules.pairs_from_truth;
  const std::string plane = NameOf(rules.plane);
  json["plane"] = plane.empty() ? OrderedJson(nullptr) : OrderedJson(plane);
  json["trajectories"] = OrderedJson::array();
  for (const ComparedTrajectory& one : compared) {
    json["trajectories"].push_back(OneTrajectory(one));
  }
  json["rules"] = {
      {"matching",
       "each pose of the shorter file with the nearest of the longer one, within "
       "max_dt_s; KITTI files line by line"},
      {"ape", "|t|, angle and Frobenius norm of P^-1 Q - I, estimate P after the alignment"},
      {"rpe", "the same of (Qi^-1 Qj)^-1 (Pi^-1 Pj)"},
      {"std", "that of the population"}};
  return json;
}

std::string TrajectoriesTable(const std::vector<ComparedTrajectory>& compared,
                              const std::string& truth, const ComparisonRules& rules) {
  const std::string plane = NameOf(rules.plane);
  std::string text = fmt::format(
      "truth {}; alignment {}{}; stamps within {} s; RPE over {}, {}\n", truth,
      NameOf(rules.align), plane.empty() ? "" : ", projected to " + plane,
      io::NumberText(rules.max_difference_s), TextOf(rules.delta), PairsText(rules));
  std::vector<std::vector<std::string>> rows{{"file", "matched", "ATE rmse m", "mean", "median",
                                              "std", "max", "rot deg", "RPE rmse m", "rot deg",
                                              "pairs", "scale"}};
  for (const ComparedTrajectory& one : compared) rows.push_back(Row(one));
  text += Columns(rows);
  for (const ComparedTrajectory& one : compared) {
    for (const std::string& reason : {one.score.no_absolute, one.score.no_relative}) {
      if (!reason.empty()) text += fmt::format("{}: -: {}\n", one.file, reason);
    }
  }
  return text;
}

const char* NameOf(AlignMode mode) {
  switch (mode) {
    case AlignMode::kOrigin:
      return "origin";
    case AlignMode::kSe3:
      return "se3";
    case AlignMode::kSim3:
      return "sim3";
    case AlignMode::kNone:
      break;
  }
  return "none";
}

std::string TextOf(const PoseDelta& delta) {
  const auto unit = static_cast<std::size_t>(delta.unit);
  constexpr const char* kUnits[] = {"f", "m", "s", "deg"};
  return io::NumberText(delta.value) + kUnits[unit];
}

const char* NameOf(ProjectionPlane plane) {
  constexpr const char* kNames[] = {"", "xy", "xz", "yz"};
  return kNames[static_cast<std::size_t>(plane)];
}

}  // namespace eval
