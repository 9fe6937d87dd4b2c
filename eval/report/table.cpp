#include "eval/report/table.h"

#include <cstdarg>
#include <cstdio>

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
  void Spread(const char* name, const std::optional<eval::Spread>& spread, const char* unit) {
    if (!spread) return Row(name, "not defined");
    Row(name, "median %.2f %s, 95 %% below %.2f", spread->median, unit, spread->p95);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void AddTrajectory(const Evaluation& e, Table& table) {
  table.Heading("Trajectory");
  const double percent = e.frames > 0 ? 100.0 * double(e.tracked) / double(e.frames) : 0.0;
  table.Row("tracked", "%zu of %zu frames (%.1f %%)", e.tracked, e.frames, percent);
  if (!e.trajectory) return table.Row("ATE", "no ground truth");
  const TrajectoryScore& t = *e.trajectory;
  if (t.ate_se3) {
    table.Row("ATE rmse (SE3)", "%.2f mm (median %.2f, max %.2f)", 1e3 * t.ate_se3->rmse,
              1e3 * t.ate_se3->median, 1e3 * t.ate_se3->max);
  } else {
    table.Row("ATE rmse (SE3)", "not defined");
  }
  if (t.ate_complete_rmse_m) {
    table.Row("ATE, missing charged", "%.2f mm", 1e3 * *t.ate_complete_rmse_m);
  }
  if (t.rpe_1s) {
    table.Row("RPE over 1 s", "%.2f mm, %.3f deg (%zu pairs)", 1e3 * t.rpe_1s->trans_rmse_m,
              t.rpe_1s->rot_rmse_deg, t.rpe_1s->pairs);
  }
}

void AddPlanes(const PlaneScore& s, Table& table) {
  table.Heading("Association");
  const DecisionCounts& d = s.association.decision;
  table.Row("decision precision", "%.4f (%d right, %d wrong)", d.scores.precision, d.tp, d.fp);
  table.Row("decision recall", "%.4f (%d missed)", d.scores.recall, d.fn);
  table.Row("pair precision, recall", "%.4f, %.4f", s.association.pair.precision,
            s.association.pair.recall);
  table.Row("IDF1, HOTA", "%.4f, %.4f", s.identity.idf1, s.hota.hota);
  table.Row("merged map planes", "%d", s.association.merged_map_planes);
  table.Heading("Planes of a frame");
  if (s.regions) {
    table.Row("correct, of truth", "%.2f of %.2f a frame (over %.2f, under %.2f, noise %.2f)",
              s.regions->correct, s.regions->truth, s.regions->over, s.regions->under,
              s.regions->noise);
  }
  table.Spread("normal error", s.normal_deg, "deg");
  table.Spread("offset error", s.offset_mm, "mm");
  table.Spread("vertex error", SpreadOf(s.corners.errors_mm), "mm");
  if (s.corners.claimed > 0 && s.corners.true_in_view > 0) {
    table.Row("vertex precision, recall", "%.4f, %.4f",
              double(s.corners.matched) / s.corners.claimed,
              double(s.corners.found_in_view) / s.corners.true_in_view);
  }
  if (!s.map) return;
  table.Heading("Map");
  table.Row("planes", "%d for %d true ones seen (%d matched, %d duplicates, %d spurious)",
            s.map->planes, s.map->true_planes_seen, s.map->matched, s.map->duplicates,
            s.map->spurious);
  table.Spread("normal error", s.map->normal_deg, "deg");
  table.Spread("offset error", s.map->offset_mm, "mm");
  table.Spread("vertex error", s.map->vertex_mm, "mm");
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
  if (e.planes) AddPlanes(*e.planes, table);
  if (e.timing) AddTiming(*e.timing, table);
  return table.text();
}

}  // namespace eval
