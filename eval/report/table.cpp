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

void AddTrajectory(const Evaluation& e, Table& table) {
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
  }
  if (t.rpe_1s) {
    table.Row("RPE over 1 s", "%.2f mm, %.3f deg (%zu pairs)", 1e3 * t.rpe_1s->trans_rmse_m,
              t.rpe_1s->rot_rmse_deg, t.rpe_1s->pairs);
  }
}

/// A share of metrics.json with four decimals, "-" when it is not defined.
std::string Share(const nlohmann::ordered_json& metrics, const std::string& figure) {
  const auto& value = metrics.at(nlohmann::ordered_json::json_pointer("/" + figure));
  return value.is_null() ? "-" : fmt::format("{:.4f}", value.get<double>());
}

/// @param metrics  the same as metrics.json says it; it knows what is defined, and why not
void AddPlanes(const PlaneScore& s, const nlohmann::ordered_json& metrics, Table& table) {
  const auto share = [&](const char* figure) { return Share(metrics, figure); };
  const auto why_not = [&](const char* figure) {
    return metrics.contains("reasons") ? metrics["reasons"].value(figure, "") : std::string();
  };
  table.Heading("Association");
  const DecisionCounts& d = s.association.decision;
  table.Row("decision precision", "%s (%d right, %d wrong)",
            share("association/decision/precision").c_str(), d.tp, d.fp);
  table.Row("decision recall", "%s (%d missed)", share("association/decision/recall").c_str(),
            d.fn);
  table.Row("pair precision, recall", "%s, %s", share("association/pair/precision").c_str(),
            share("association/pair/recall").c_str());
  table.Row("IDF1, HOTA", "%s, %s", share("association/idf1").c_str(),
            share("association/hota").c_str());
  table.Row("merged map planes", "%d", s.association.merged_map_planes);
  table.Heading("Planes of a frame");
  if (s.regions) {
    table.Row("correct, of truth", "%.2f of %.2f a frame (over %.2f, under %.2f, noise %.2f)",
              s.regions->correct, s.regions->truth, s.regions->over, s.regions->under,
              s.regions->noise);
  }
  table.Spread("normal error", s.normal_deg, "deg", why_not("extraction/normal_deg"));
  table.Spread("offset error", s.offset_mm, "mm", why_not("extraction/offset_mm"));
  table.Spread("vertex error", SpreadOf(s.corners.errors_mm), "mm",
               why_not("vertices/error_mm"));
  table.Row("vertex precision, recall", "%s, %s", share("vertices/precision").c_str(),
            share("vertices/recall").c_str());
  if (!s.map) return;
  table.Heading("Map");
  table.Row("planes", "%d for %d true ones seen (%d matched, %d duplicates, %d spurious)",
            s.map->planes, s.map->true_planes_seen, s.map->matched, s.map->duplicates,
            s.map->spurious);
  table.Spread("normal error", s.map->normal_deg, "deg", why_not("map/normal_deg"));
  table.Spread("offset error", s.map->offset_mm, "mm", why_not("map/offset_mm"));
  table.Spread("vertex error", s.map->vertex_mm, "mm", why_not("map/vertex_mm"));
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
  AddTrajectory(e, table);
  if (e.planes) AddPlanes(*e.planes, MetricsJson(e), table);
  if (e.timing) AddTiming(*e.timing, table);
  return table.text();
}

}  // namespace eval
