#include "eval/report/table.h"

#include <fmt/format.h>

#include <cstdarg>
#include <cstdio>

#include "eval/report/metrics_json.h"

namespace eval {
namespace {

class Table {
 public:
  /// printf of one line; the C locale's point is not assumed elsewhere, this is for reading.
  __attribute__((format(printf, 3, 4))) void Row(const char* name, const char* format, ...) {
    char value[160];
    va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(value, sizeof value, format, arguments);
    va_end(arguments);
    char line[240];
    std::snprintf(line, sizeof line, "  %-26s %s\n", name, value);
    text_ += line;
  }
  void Heading(const char* heading) { text_ += std::string(heading) + "\n"; }
  void Undefined(const char* name, const std::string& reason) {
    Row(name, "-  (%s)", reason.c_str());
  }
  void Spread(const char* name, const std::optional<eval::Spread>& spread, const char* unit,
              const std::string& no_spread) {
    if (!spread) return Undefined(name, no_spread);
    Row(name, "median %.2f %s, 95 %% below %.2f", spread->median, unit, spread->p95);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void AddClaims(const char* name, const std::optional<ClaimScore>& claims,
               const std::string& no_claims, Table& table) {
  if (!claims) return table.Undefined(name, no_claims);
  table.Row(name, "NEES %.1f, %.1f of 3 (inside %.2f, %.2f), silent %zu of %zu",
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
  table.Row("tracked", "%zu of %zu frames (%.1f %%)", t.tracked, t.frames, percent);
  if (t.ate_se3) {
    table.Row("ATE rmse (SE3)", "%.2f mm (median %.2f, max %.2f)", 1e3 * t.ate_se3->rmse,
              1e3 * t.ate_se3->median, 1e3 * t.ate_se3->max);
  } else {
    table.Undefined("ATE rmse (SE3)", t.no_ate_se3);
  }
  if (t.ate_complete_rmse_m) {
    table.Row("ATE, missing charged", "%.2f mm", 1e3 * *t.ate_complete_rmse_m);
  } else {
    table.Undefined("ATE, missing charged", t.no_ate_complete);
  }
  if (t.rpe_1s) {
    table.Row("RPE over 1 s", "%.2f mm, %.3f deg (%zu pairs)", 1e3 * t.rpe_1s->trans_rmse_m,
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
  table.Row("decision precision", "%s (%d right, %d wrong)",
            texts.Share("association/decision/precision").c_str(), d.tp, d.fp);
  table.Row("decision recall", "%s (%d missed)",
            texts.Share("association/decision/recall").c_str(), d.fn);
  table.Row("no decision", "%s (%zu of %d large surfaces of frames)",
            texts.Share("association/no_decision/share").c_str(), s.undecided.undecided.size(),
            s.undecided.large);
  if (s.history.says_by) {
    table.Row("ambiguous", "%zu frame planes of surfaces in the map", s.ambiguous.size());
  } else {
    table.Undefined("ambiguous", texts.WhyNot("association/decision/ambiguous"));
  }
  table.Row("pair precision, recall", "%s, %s",
            texts.Share("association/pair/precision").c_str(),
            texts.Share("association/pair/recall").c_str());
  table.Row("IDF1, HOTA", "%s, %s", texts.Share("association/idf1").c_str(),
            texts.Share("association/hota").c_str());
  table.Row("merged map planes", "%d", s.association.merged_map_planes);
}

void AddExtraction(const PlaneScore& s, const MetricTexts& texts, Table& table) {
  table.Heading("Planes of a frame");
  if (s.regions) {
    table.Row("correct, of truth", "%.2f of %.2f a frame (over %.2f, under %.2f, noise %.2f)",
              s.regions->correct, s.regions->truth, s.regions->over, s.regions->under,
              s.regions->noise);
  }
  if (!s.from_frame_planes) {
    table.Row("panoptic quality", "%s (segments %s, recognition %s)",
              texts.Share("extraction/pq").c_str(), texts.Share("extraction/sq").c_str(),
              texts.Share("extraction/rq").c_str());
    table.Row("pixel precision, recall", "%s, %s",
              texts.Share("extraction/pixel_precision").c_str(),
              texts.Share("extraction/pixel_recall").c_str());
    return;
  }
  table.Spread("normal error", s.normal_deg, "deg", texts.WhyNot("extraction/normal_deg"));
  table.Spread("offset error", s.offset_mm, "mm", texts.WhyNot("extraction/offset_mm"));
  table.Spread("vertex error", SpreadOf(s.corners.errors_mm), "mm",
               texts.WhyNot("vertices/error_mm"));
  table.Row("vertex precision, recall", "%s, %s", texts.Share("vertices/precision").c_str(),
            texts.Share("vertices/recall").c_str());
}

void AddMap(const MapScore& map, const MetricTexts& texts, Table& table) {
  table.Heading("Map");
  table.Row("planes", "%d for %d true ones seen (%d matched, %d duplicates, %d spurious)",
            map.planes, map.true_planes_seen, map.matched, map.duplicates, map.spurious);
  table.Spread("normal error", map.normal_deg, "deg", texts.WhyNot("map/normal_deg"));
  table.Spread("offset error", map.offset_mm, "mm", texts.WhyNot("map/offset_mm"));
  table.Spread("vertex error", map.vertex_mm, "mm", texts.WhyNot("map/vertex_mm"));
}

void AddPlanes(const PlaneScore& s, const MetricTexts& texts, Table& table) {
  if (s.from_frame_planes) AddAssociation(s, texts, table);
  if (s.from_frame_planes || s.regions) AddExtraction(s, texts, table);
  if (s.map) AddMap(*s.map, texts, table);
}

void AddTiming(const TimingScore& t, Table& table) {
  table.Heading("Time per module, ms a frame");
  for (const ModuleTime& m : t.modules) {
    table.Row(m.module.c_str(), "mean %8.2f   median %8.2f   95 %% below %8.2f", m.mean,
              m.median, m.p95);
  }
  if (t.fps) table.Row("frames a second", "%.1f", *t.fps);
  if (t.peak_rss_mb) table.Row("peak memory", "%.0f MB", *t.peak_rss_mb);
}

}  // namespace

std::string MetricsTable(const Evaluation& e) {
  Table table;
  const MetricTexts texts(MetricsJson(e));
  AddTrajectory(e, texts, table);
  if (e.planes) AddPlanes(*e.planes, texts, table);
  if (e.timing) AddTiming(*e.timing, table);
  return table.text();
}

std::string LabelsTable(const LabelEvaluation& e) {
  Table table;
  AddPlanes(e.planes, MetricTexts(LabelsJson(e)), table);
  return table.text();
}

}  // namespace eval
