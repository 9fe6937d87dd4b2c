#include "eval/report/table.h"

#include <fmt/format.h>

#include <string>
#include <utility>

#include "eval/report/metrics_json.h"

namespace eval {
namespace {

class Table {
 public:
  template <typename... Values>
  void Row(const std::string& name, fmt::format_string<Values...> format, Values&&... values) {
    text_ += fmt::format("  {:<26} {}\n", name,
                         fmt::format(format, std::forward<Values>(values)...));
  }
  void Heading(const char* heading) { text_ += std::string(heading) + "\n"; }
  void Undefined(const char* name, const std::string& reason) { Row(name, "-  ({})", reason); }
  void Spread(const char* name, const std::optional<eval::Spread>& spread, const char* unit,
              const std::string& no_spread) {
    if (!spread) return Undefined(name, no_spread);
    Row(name, "median {:.2f} {}, 95 % below {:.2f}", spread->median, unit, spread->p95);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void AddClaims(const char* name, const std::optional<ClaimScore>& claims,
               const std::string& no_claims, Table& table) {
  if (!claims) return table.Undefined(name, no_claims);
  table.Row(name, "NEES {:.1f}, {:.1f} of 3 (inside {:.2f}, {:.2f}), silent {} of {}",
            claims->position.mean, claims->rotation.mean, claims->position.inside,
            claims->rotation.inside, claims->silent, claims->count);
}

/// The figures as metrics.json says them; it knows what is defined, and why not.
class MetricTexts {
 public:
  explicit MetricTexts(nlohmann::ordered_json metrics) : metrics_(std::move(metrics)) {}
  /// A share of metrics.json with four decimals, "-" when it is not defined.
  std::string Share(const std::string& figure) const {
    const auto& value = metrics_.at(nlohmann::ordered_json::json_pointer("/" + figure));
    return value.is_null() ? "-" : fmt::format("{:.4f}", value.get<double>());
  }
  std::string WhyNot(const char* figure) const {
    return metrics_.contains("reasons") ? metrics_["reasons"].value(figure, "") : std::string();
  }

 private:
  nlohmann::ordered_json metrics_;
};

void AddTrajectory(const Evaluation& e, const MetricTexts& texts, Table& table) {
  table.Heading("Trajectory");
  const TrajectoryScore& t = e.trajectory;
  const double percent = t.frames > 0 ? 100.0 * double(t.tracked) / double(t.frames) : 0.0;
  table.Row("tracked", "{} of {} frames ({:.1f} %)", t.tracked, t.frames, percent);
  if (t.ate_se3) {
    table.Row("ATE rmse (SE3)", "{:.2f} mm (median {:.2f}, max {:.2f})", 1e3 * t.ate_se3->rmse,
              1e3 * t.ate_se3->median, 1e3 * t.ate_se3->max);
  } else {
    table.Undefined("ATE rmse (SE3)", t.no_ate_se3);
  }
  if (t.ate_complete_rmse_m) {
    table.Row("ATE, missing charged", "{:.2f} mm", 1e3 * *t.ate_complete_rmse_m);
  } else {
    table.Undefined("ATE, missing charged", t.no_ate_complete);
  }
  if (t.rpe_1s) {
    table.Row("RPE over 1 s", "{:.2f} mm, {:.3f} deg ({} pairs)", 1e3 * t.rpe_1s->trans_rmse_m,
              t.rpe_1s->rot_rmse_deg, t.rpe_1s->pairs);
  } else {
    table.Undefined("RPE over 1 s", texts.WhyNot("trajectory/rpe_1s"));
  }
  if (t.consistency) {
    AddClaims("told error", t.consistency->absolute, t.consistency->no_absolute, table);
    AddClaims("told error over 1 s", t.consistency->relative, t.consistency->no_relative,
              table);
  }
}

void AddAssociation(const PlaneScore& s, const MetricTexts& texts, Table& table) {
  table.Heading("Association");
  const DecisionCounts& d = s.association.decision;
  table.Row("decision precision", "{} ({} right, {} wrong)",
            texts.Share("association/decision/precision"), d.tp, d.fp);
  table.Row("decision recall", "{} ({} missed)", texts.Share("association/decision/recall"),
            d.fn);
  table.Row("no decision", "{} ({} of {} large surfaces of frames)",
            texts.Share("association/no_decision/share"), s.undecided.undecided.size(),
            s.undecided.large);
  if (s.history.says_by) {
    table.Row("ambiguous", "{} frame planes of surfaces in the map", s.ambiguous.size());
  } else {
    table.Undefined("ambiguous", texts.WhyNot("association/decision/ambiguous"));
  }
  table.Row("pair precision, recall", "{}, {}", texts.Share("association/pair/precision"),
            texts.Share("association/pair/recall"));
  table.Row("IDF1, HOTA", "{}, {}", texts.Share("association/idf1"),
            texts.Share("association/hota"));
  table.Row("merged map planes", "{}", s.association.merged_map_planes);
}

void AddExtraction(const PlaneScore& s, const MetricTexts& texts, Table& table) {
  table.Heading("Planes of a frame");
  if (s.regions) {
    table.Row("correct, of truth",
              "{:.2f} of {:.2f} a frame (over {:.2f}, under {:.2f}, noise {:.2f})",
              s.regions->correct, s.regions->truth, s.regions->over, s.regions->under,
              s.regions->noise);
  }
  if (!s.from_frame_planes) {
    table.Row("panoptic quality", "{} (segments {}, recognition {})",
              texts.Share("extraction/pq"), texts.Share("extraction/sq"),
              texts.Share("extraction/rq"));
    table.Row("pixel precision, recall", "{}, {}", texts.Share("extraction/pixel_precision"),
              texts.Share("extraction/pixel_recall"));
    return;
  }
  table.Spread("normal error", s.normal_deg, "deg", texts.WhyNot("extraction/normal_deg"));
  table.Spread("offset error", s.offset_mm, "mm", texts.WhyNot("extraction/offset_mm"));
  table.Spread("vertex error", SpreadOf(s.corners.errors_mm), "mm",
               texts.WhyNot("vertices/error_mm"));
  table.Row("vertex precision, recall", "{}, {}", texts.Share("vertices/precision"),
            texts.Share("vertices/recall"));
}

void AddMap(const MapScore& map, const MetricTexts& texts, Table& table) {
  table.Heading("Map");
  if (map.comparable) {
    table.Row("planes", "{} for {} true ones seen ({} matched, {} duplicates, {} spurious)",
              map.planes, map.true_planes_seen, map.matched, map.duplicates, map.spurious);
  } else {
    table.Row("planes", "{} for {} true ones seen", map.planes, map.true_planes_seen);
    table.Undefined("matched", texts.WhyNot("map/matched"));
  }
  table.Spread("normal error", map.normal_deg, "deg", texts.WhyNot("map/normal_deg"));
  table.Spread("offset error", map.offset_mm, "mm", texts.WhyNot("map/offset_mm"));
  table.Spread("vertex error", map.vertex_mm, "mm", texts.WhyNot("map/vertex_mm"));
  if (map.claims) {
    table.Row("told error", "NEES {:.1f} of 3 (inside {:.2f}), silent {} of {}",
              map.claims->nees.mean, map.claims->nees.inside, map.claims->silent,
              map.claims->count);
  } else {
    table.Undefined("told error", texts.WhyNot("map/consistency"));
  }
}

void AddPlanes(const PlaneScore& s, const MetricTexts& texts, Table& table) {
  if (s.from_frame_planes) AddAssociation(s, texts, table);
  if (s.from_frame_planes || s.regions) AddExtraction(s, texts, table);
  if (s.map) AddMap(*s.map, texts, table);
}

void AddTiming(const TimingScore& t, Table& table) {
  table.Heading("Time per module, ms a frame");
  for (const ModuleTime& m : t.modules) {
    table.Row(m.module, "mean {:8.2f}   median {:8.2f}   95 % below {:8.2f}", m.mean, m.median,
              m.p95);
  }
  if (t.fps) table.Row("frames a second", "{:.1f}", *t.fps);
  if (t.peak_rss_mb) table.Row("peak memory", "{:.0f} MB", *t.peak_rss_mb);
}

}  // namespace

std::string MetricsTable(const Evaluation& e) {
  Table table;
  const MetricTexts texts(MetricsJson(e));
  AddTrajectory(e, texts, table);
  if (e.planes) AddPlanes(*e.planes, texts, table);
  if (!e.groups_without_truth.empty()) {
    table.Heading("Planes");
    table.Undefined("all figures", e.no_planes);
  }
  if (e.timing) AddTiming(*e.timing, table);
  return table.text();
}

std::string LabelsTable(const LabelEvaluation& e) {
  Table table;
  AddPlanes(e.planes, MetricTexts(LabelsJson(e)), table);
  return table.text();
}

}  // namespace eval
