#include "eval/report/metrics_json.h"

#include <string>

namespace eval {
namespace {

using Json = nlohmann::ordered_json;

Json ToJson(const Statistics& s) {
  return {{"rmse_m", s.rmse},
          {"mean_m", s.mean},
          {"median_m", s.median},
          {"std_m", s.std_dev},
          {"max_m", s.max}};
}

Json ToJson(const RelativeScore& s) {
  return {
      {"trans_rmse_m", s.trans_rmse_m}, {"rot_rmse_deg", s.rot_rmse_deg}, {"pairs", s.pairs}};
}

Json ToJson(const PrecisionRecall& s) {
  return {{"precision", s.precision}, {"recall", s.recall}, {"f1", s.f1}};
}

template <typename Value>
void Put(Json& group, const char* key, const std::optional<Value>& value) {
  if (value) group[key] = ToJson(*value);
}
void Put(Json& group, const char* key, const std::optional<Spread>& spread) {
  if (spread) group[key] = {{"median", spread->median}, {"p95", spread->p95}};
}
void Put(Json& group, const char* key, const std::optional<double>& value) {
  if (value) group[key] = *value;
}

Json TrajectoryGroup(const TrajectoryScore& s) {
  Json group;
  group["frames"] = s.frames;
  group["tracked"] = s.tracked;
  if (s.frames > 0) group["tracked_fraction"] = double(s.tracked) / double(s.frames);
  group["lost_events"] = s.lost_events;
  Put(group, "ate_se3", s.ate_se3);
  Put(group, "ate_origin", s.ate_origin);
  Put(group, "ate_complete_rmse_m", s.ate_complete_rmse_m);
  Put(group, "rpe_1s", s.rpe_1s);
  Put(group, "rpe_1m", s.rpe_1m);
  return group;
}

Json ExtractionGroup(const PlaneScore& s) {
  Json group;
  if (s.regions) {
    const RegionScore& r = *s.regions;
    group["truth"] = r.truth;
    group["machine"] = r.machine;
    group["correct"] = r.correct;
    group["over"] = r.over;
    group["under"] = r.under;
    group["missed"] = r.missed;
    group["noise"] = r.noise;
    group["pq"] = r.panoptic.Pq();
    group["sq"] = r.panoptic.Sq();
    group["rq"] = r.panoptic.Rq();
    group["pixel_precision"] = r.pixel_precision;
    group["pixel_recall"] = r.pixel_recall;
  }
  Put(group, "normal_deg", s.normal_deg);
  Put(group, "offset_mm", s.offset_mm);
  return group;
}

Json VertexGroup(const CornerCounts& c) {
  Json group;
  if (c.claimed > 0) group["precision"] = double(c.matched) / c.claimed;
  if (c.true_in_view > 0) group["recall"] = double(c.found_in_view) / c.true_in_view;
  Put(group, "error_mm", SpreadOf(c.errors_mm));
  if (c.faces_in_view > 0) group["planes_with_4"] = double(c.faces_with_4) / c.faces_in_view;
  return group;
}

Json AssociationGroup(const PlaneScore& s) {
  const AssociationScore& a = s.association;
  const DecisionCounts& d = a.decision;
  Json group;
  group["pair"] = ToJson(a.pair);
  group["b_cubed"] = ToJson(a.b_cubed);
  group["decision"] = {{"precision", d.scores.precision},
                       {"recall", d.scores.recall},
                       {"f1", d.scores.f1},
                       {"tp", d.tp},
                       {"fp", d.fp},
                       {"fn", d.fn},
                       {"tn", d.tn},
                       {"spurious", d.spurious}};
  group["idf1"] = s.identity.idf1;
  group["hota"] = s.hota.hota;
  group["ass_a"] = s.hota.ass_a;
  group["mota"] = s.clear.mota;
  group["id_switches"] = s.clear.id_switches;
  group["merged_map_planes"] = a.merged_map_planes;
  group["split_truth_planes"] = a.split_truth_planes;
  return group;
}

Json MapGroup(const MapScore& m) {
  Json group;
  group["planes"] = m.planes;
  group["true_planes_seen"] = m.true_planes_seen;
  group["matched"] = m.matched;
  group["duplicates"] = m.duplicates;
  group["merged"] = m.merged;
  group["spurious"] = m.spurious;
  Put(group, "normal_deg", m.normal_deg);
  Put(group, "offset_mm", m.offset_mm);
  Put(group, "vertex_mm", m.vertex_mm);
  if (m.polygon_iou_median) group["polygon_iou"] = {{"median", *m.polygon_iou_median}};
  Put(group, "area_explained", m.area_explained);
  return group;
}

Json TimingGroup(const TimingScore& t) {
  Json group = Json::object();
  for (const ModuleTime& m : t.modules) {
    group[m.module] = {{"mean", m.mean}, {"median", m.median}, {"p95", m.p95}};
  }
  Put(group, "fps", t.fps);
  Put(group, "peak_rss_mb", t.peak_rss_mb);
  return group;
}

Json TrajectoryRules(const TrajectoryScore& s) {
  Json rules;
  rules["trajectory"] =
      "matched by equal stamps on synthetic data, else by the nearest within 10 ms; a frame is "
      "tracked if the run gives a pose for it; lost_events counts changes from tracked to not";
  rules["ate_complete_rmse_m"] =
      "over all frames with truth, SE(3)-aligned on the tracked ones; every missing frame is "
      "charged the diameter of the true path";
  rules["rpe"] =
      "all pairs; 1 s by time, kept within half a frame; 1 m by the length of the true path, "
      "kept within 0.1 m";
  if (!s.ate_se3) {
    rules["ate_se3"] =
        "not defined: fewer than 3 matched poses, or their positions lie on a line to working "
        "precision";
  }
  return rules;
}

void AddPlaneRules(const PlaneScore& s, Json& rules) {
  rules["truth"] =
      "planes of structure and regular objects are scored, everything else is noise; a true "
      "plane "
      "counts in a frame if at least 1000 of its pixels show (at 640 x 480, scaled with the "
      "area) "
      "and it is seen at 75 deg of incidence or less at their middle; planes that show one "
      "that "
      "does not count are left out of extraction and tracking scores; faces of one object or "
      "detection group that are one plane to 0.1 mm, with joints of at most 30 mm, are one "
      "true "
      "plane";
  rules["truth_of_a_frame_plane"] =
      s.by_pixels ? "the scored plane that holds most of its pixels, none if most show none"
                  : "no segmentation images: of the scored planes in view within 20 deg, the "
                    "one with the "
                    "least offset at the centroid (at most 50 mm), by place where offsets "
                    "agree to 5 mm";
  rules["extraction"] = s.by_pixels
                            ? "frame planes that the run trusts (bad = null); Hoover at 80 %, "
                              "means per frame; pq over all frames; offset at the centroid"
                            : "frame planes that the run trusts (bad = null); offset at the "
                              "centroid; no segmentation images, so nothing by pixels";
  rules["vertices"] =
      "corners of trusted frame planes, one to one within 50 mm of the true corners of the "
      "plane "
      "they show; recall over true corners inside the image and not hidden, of planes that "
      "count; "
      "planes_with_4 over such top faces of regular objects with four corners in view";
  rules["association"] =
      "decisions as made at their frame; those of a frame are simultaneous; idf1, hota and "
      "mota "
      "from masks of map planes" +
      std::string(s.by_pixels ? ""
                              : ", here with similarity 1 for a plane that shows the truth");
  if (s.map) {
    rules["map"] =
        "in the world of the truth by the mean rotation and the mean position of all matched "
        "poses; a map plane belongs to the truth of most of its observations, that with "
        "most of them is the match; offset is the rms distance of the true vertices to "
        "the map plane; vertices one to one within 100 mm; normals are oriented";
  }
}

}  // namespace

Json MetricsJson(const Evaluation& e) {
  Json json;
  json["format"] = "pas-metrics/1";
  if (e.trajectory) {
    json["trajectory"] = TrajectoryGroup(*e.trajectory);
  } else {
    json["trajectory"] = {{"frames", e.frames}, {"tracked", e.tracked}};
  }
  if (e.planes) {
    json["extraction"] = ExtractionGroup(*e.planes);
    json["vertices"] = VertexGroup(e.planes->corners);
    json["association"] = AssociationGroup(*e.planes);
    if (e.planes->map) json["map"] = MapGroup(*e.planes->map);
  }
  if (e.timing) json["timing_ms"] = TimingGroup(*e.timing);
  json["rules"] = e.trajectory ? TrajectoryRules(*e.trajectory) : Json::object();
  if (e.planes) AddPlaneRules(*e.planes, json["rules"]);
  return json;
}

std::string MetricsText(const Evaluation& evaluation) {
  return MetricsJson(evaluation).dump(2) + "\n";
}

}  // namespace eval
