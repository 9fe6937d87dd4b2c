#include "eval/report/metrics_json.h"

#include <string>
#include <utility>

#include "eval/report/figure_group.h"

namespace eval {
namespace {

using Json = nlohmann::ordered_json;

Json TrajectoryGroup(const TrajectoryScore& s, Json& reasons) {
  const auto why = [&](const char* otherwise) {
    return s.no_match.empty() ? std::string(otherwise) : s.no_match;
  };
  FigureGroup group("trajectory", reasons);
  group.Put("frames", s.frames);
  group.Put("tracked", s.tracked);
  group.PutShare("tracked_fraction", double(s.tracked) / double(s.frames), s.frames > 0,
                 "the sequence has no frames");
  group.Put("lost_events", s.lost_events);
  group.Put("ate_se3", s.ate_se3, s.no_ate_se3);
  group.Put("ate_origin", s.ate_origin, s.no_match);
  group.Put("ate_complete_rmse_m", s.ate_complete_rmse_m, s.no_ate_complete);
  group.Put("rpe_1s", s.rpe_1s, why("no two matched poses are 1 s apart"));
  group.Put("rpe_1m", s.rpe_1m, why("no two matched poses are 1 m of the true path apart"));
  return group.json();
}

Json ConsistencyGroup(const ConsistencyScore& s, Json& reasons) {
  FigureGroup group("consistency", reasons);
  group.Put("absolute", s.absolute, s.no_absolute);
  group.Put("relative_1s", s.relative, s.no_relative);
  return group.json();
}

void PutRegions(const RegionScore& r, FigureGroup& group) {
  group.Put("truth", r.truth);
  group.Put("machine", r.machine);
  group.Put("correct", r.correct);
  group.Put("over", r.over);
  group.Put("under", r.under);
  group.Put("missed", r.missed);
  group.Put("noise", r.noise);
  const bool any = r.truth > 0.0 || r.machine > 0.0;
  const char* const none = "no frame shows a plane that counts, nor was one found";
  group.PutShare("pq", r.panoptic.Pq(), any, none);
  group.PutShare("sq", r.panoptic.Sq(), r.panoptic.tp > 0,
                 "no found plane has an IoU above 0.5 with a true one");
  group.PutShare("rq", r.panoptic.Rq(), any, none);
  group.PutShare("pixel_precision", r.pixel_precision, r.machine > 0.0, "no plane was found");
  const char* const no_truth = "no frame shows a plane that counts";
  group.PutShare("pixel_recall", r.pixel_recall, r.truth > 0.0, no_truth);
  group.PutShare("correct_ratio", r.correct_ratio, r.truth > 0.0, no_truth);
  group.PutShare("correct_pixel_ratio", r.correct_pixel_ratio, r.truth > 0.0, no_truth);
  group.PutShare("ri", r.rand_index, any, none);
  group.PutShare("voi_bits", r.voi_bits, any, none);
  group.PutShare("sc", r.covering, any, none);
  if (!any) return group.Undefined("evops", none);
  const EvopsScore& e = r.evops;
  group.Put("evops", Json{{"precision", e.precision},
                          {"recall", e.recall},
                          {"f1", e.f1},
                          {"mean_iou", e.mean_iou},
                          {"mean_dice", e.mean_dice},
                          {"panoptic", e.panoptic},
                          {"usr", e.under_ratio},
                          {"osr", e.over_ratio},
                          {"noise", e.noise_ratio},
                          {"missed", e.missed_ratio}});
}

Json ExtractionGroup(const PlaneScore& s, Json& reasons) {
  FigureGroup group("extraction", reasons);
  if (s.regions) {
    PutRegions(*s.regions, group);
  } else {
    for (const char* key :
         {"truth", "machine", "correct", "over", "under", "missed", "noise", "pq", "sq", "rq",
          "pixel_precision", "pixel_recall", "correct_ratio", "correct_pixel_ratio", "ri",
          "voi_bits", "sc", "evops"}) {
      group.Undefined(key,
                      "the run has no segmentation images, or the sequence no gt/plane_id");
    }
  }
  const char* const none = s.from_frame_planes
                               ? "no trusted frame plane shows a true plane"
                               : "the run has no frame_planes.jsonl: labels have no geometry";
  group.Put("normal_deg", s.normal_deg, none);
  group.Put("offset_mm", s.offset_mm, none);
  return group.json();
}

Json VertexGroup(const CornerCounts& c, Json& reasons) {
  FigureGroup group("vertices", reasons);
  group.PutShare("precision", double(c.matched) / c.claimed, c.claimed > 0,
                 "no trusted frame plane has a vertex");
  group.PutShare("recall", double(c.found_in_view) / c.true_in_view, c.true_in_view > 0,
                 "no true corner is in view");
  group.Put("error_mm", SpreadOf(c.errors_mm), "no vertex is near a true corner");
  group.PutShare("planes_with_4", double(c.faces_with_4) / c.faces_in_view, c.faces_in_view > 0,
                 "no top face of a regular object is in view with four corners");
  return group.json();
}

Json AssociationGroup(const PlaneScore& s, Json& reasons) {
  const AssociationScore& a = s.association;
  const DecisionCounts& d = a.decision;
  const auto unless = [](bool defined, const char* reason) {
    return std::string(defined ? "" : reason);
  };
  FigureGroup group("association", reasons);
  group.PutShares("pair", a.pair,
                  unless(a.pair_predicted > 0, "no two decisions name one map plane"),
                  unless(a.pair_truth > 0, "no two decisions show one true plane"));
  const std::string no_truth =
      unless(a.records_with_truth > 0, "no decision was made on a frame plane with a truth");
  group.PutShares("b_cubed", a.b_cubed, no_truth, no_truth);
  group.PutShare("purity", a.partition.purity, no_truth.empty(), no_truth);
  group.PutShare("inverse_purity", a.partition.inverse_purity, no_truth.empty(), no_truth);
  group.PutShare("voi_bits", a.partition.VoiBits(), no_truth.empty(), no_truth);
  group.PutShares(
      "decision", d.scores,
      unless(d.tp + d.fp > 0, "no frame plane was matched to a map plane"),
      unless(d.tp + d.fn > 0, "no decision was made on a surface that was in the map already"));
  group.Put("decision/tp", d.tp);
  group.Put("decision/fp", d.fp);
  group.Put("decision/fn", d.fn);
  group.Put("decision/tn", d.tn);
  group.Put("decision/spurious", d.spurious);
  if (s.history.says_by) {
    group.Put("decision/ambiguous", s.ambiguous.size());
  } else {
    group.Undefined("decision/ambiguous",
                    "the run says of no frame plane what settled it (`by`)");
  }
  const bool any = s.identity.idtp + s.identity.idfp + s.identity.idfn > 0;
  const char* const none = "no frame shows a plane that counts or one of the map";
  group.PutShare("idf1", s.identity.idf1, any, none);
  group.PutShare("hota", s.hota.hota, any, none);
  group.PutShare("ass_a", s.hota.ass_a, any, none);
  group.PutShare("mota", s.clear.mota, s.clear.tp + s.clear.fn > 0,
                 "no frame shows a plane that counts");
  group.Put("id_switches", s.clear.id_switches);
  const int undecided = static_cast<int>(s.undecided.undecided.size());
  group.PutShare("no_decision/share", double(undecided) / s.undecided.large,
                 s.undecided.large > 0,
                 "no frame shows a large surface that has a map plane, after the first second");
  group.Put("no_decision/events", undecided);
  group.Put("no_decision/surfaces", s.undecided.large);
  group.Put("merged_map_planes", a.merged_map_planes);
  group.Put("split_truth_planes", a.split_truth_planes);
  return group.json();
}

Json MapGroup(const MapScore& m, const TrajectoryScore& trajectory, Json& reasons) {
  const auto why = [&](const char* otherwise) {
    if (trajectory.gauge) return std::string(otherwise);
    return trajectory.no_match.empty()
               ? "the rotations of run and truth contradict each other: no alignment is best"
               : trajectory.no_match;
  };
  const char* const none = "no map plane shows a true plane that counts";
  const char* const no_outline = "no map plane has an outline: a hull or three vertices";
  FigureGroup group("map", reasons);
  const auto put_count = [&](const char* key, int count) {
    if (m.comparable) return group.Put(key, count);
    group.Undefined(key, why(no_outline));
  };
  group.Put("planes", m.planes);
  group.Put("true_planes_seen", m.true_planes_seen);
  put_count("matched", m.matched);
  put_count("duplicates", m.duplicates);
  if (m.merged) {
    group.Put("merged", *m.merged);
  } else {
    group.Undefined("merged", "the run has no frame_planes.jsonl, which tells its decisions");
  }
  put_count("spurious", m.spurious);
  group.Put("normal_deg", m.normal_deg, why(none));
  group.Put("offset_mm", m.offset_mm, why(none));
  group.Put("vertex_mm", m.vertex_mm, why("no vertex of the map is near a true corner"));
  group.Put("consistency", m.claims,
            why("map.json tells no covariance of a plane that shows a true one"));
  const char* const no_outlines = "no matched map plane has an outline";
  if (m.polygon_iou_median) {
    group.Put("polygon_iou", Json{{"median", *m.polygon_iou_median}});
  } else {
    group.Undefined("polygon_iou", why(no_outlines));
  }
  group.Put("polygon_hausdorff_mm", m.polygon_hausdorff_mm, why(no_outlines));
  group.Put("area_explained", m.area_explained,
            why(m.has_outlines ? "no true plane counts" : no_outline));
  return group.json();
}

Json TimingGroup(const TimingScore& t, Json& reasons) {
  FigureGroup group("timing_ms", reasons);
  for (const ModuleTime& m : t.modules) {
    group.PutNamed(m.module, Json{{"mean", m.mean}, {"median", m.median}, {"p95", m.p95}});
  }
  group.Put("fps", t.fps, "timing.csv has no times of mt, the whole tracking");
  group.Put("peak_rss_mb", t.peak_rss_mb, "run.json does not tell");
  return group.json();
}

/// @param place  stands for the folder of the run, or of the labels
Json Warnings(const std::vector<Fault>& of_run, const char* place,
              const std::vector<Fault>& of_sequence) {
  Json warnings = Json::array();
  for (std::string& line : Summaries(of_run, place)) warnings.push_back(std::move(line));
  for (std::string& line : Summaries(of_sequence, "SEQ")) {
    warnings.push_back(std::move(line));
  }
  return warnings;
}

constexpr const char* kConsistencyRule =
    "squared errors by the covariance that the run tells of them, whose mean is 3 (position, "
    "rotation) and 6 (pose) and of which 0.95 are inside where it is honest; "
    "absolute: in the world of the truth by whole poses, drift and all; "
    "relative_1s: of the motion over 1 s, the covariances of both poses summed; "
    "silent: position or rotation is off by more than 5 of its own standard deviations in some "
    "direction";

Json TrajectoryRules() {
  Json rules;
  rules["trajectory"] =
      "matched by equal stamps on synthetic data, else by the nearest within 10 ms; a frame is "
      "tracked if the run gives a pose for it; lost_events counts changes from tracked to not";
  rules["ate_complete_rmse_m"] =
      "over all frames with truth, one pose a frame, aligned as ate_se3; every frame without a "
      "pose is charged the diameter of the true path";
  rules["rpe"] =
      "all pairs; 1 s by time, kept within half a frame; 1 m by the length of the true path, "
      "kept within 0.1 m";
  return rules;
}

void AddExtractionRules(const PlaneScore& s, Json& rules) {
  rules["truth_of_a_frame_plane"] =
      s.by_pixels ? "the scored plane that holds most of its pixels, none if most show none"
                  : "no segmentation images: of the scored planes in view within 30 deg, 50 mm "
                    "of the centroid and 50 mm of its outline, the likest by offset (10 mm) "
                    "and pixels shown (a factor e)";
  rules["extraction"] = s.by_pixels
                            ? "frame planes that the run trusts (bad = null); Hoover at 80 %, "
                              "means per frame; pq, pixels and ratios over all frames; ri, "
                              "voi_bits and sc with what no plane holds as a region, evops at "
                              "IoU 0.75 and 0.2: means per frame; offset at the centroid"
                            : "frame planes that the run trusts (bad = null); offset at the "
                              "centroid; no segmentation images, so nothing by pixels";
}

void AddAssociationRules(const PlaneScore& s, Json& rules) {
  rules["vertices"] =
      "corners of trusted frame planes, one to one within 50 mm of the true corners of the "
      "plane they show; recall over true corners inside the image and not hidden, of planes "
      "that count; planes_with_4 over such top faces of regular objects with four corners in "
      "view";
  rules["association"] =
      "decisions as made at their frame; those of a frame are simultaneous; a map plane is of "
      "the truth that showed most pixels of it in its first frame, also after the run split "
      "it; idf1, hota and mota from masks of map planes" +
      std::string(
          s.by_pixels ? "" : ", here from the pixels of frame planes by the truth they show");
  rules["no_decision"] =
      "of surfaces over 5 % of the image that count and have a map plane since an earlier "
      "frame, after the first second: those whose largest frame plane was put on none, or that "
      "have none";
  rules["ambiguous"] =
      "frame planes that were put on no map plane and of which the run says by = ambiguous, of "
      "a scored true plane that has a map plane since an earlier frame; none of them is in "
      "precision or recall";
}

void AddPlaneRules(const PlaneScore& s, Json& rules) {
  rules["truth"] =
      "planes of structure and regular objects are scored, everything else is noise; "
      "a true plane counts in a frame if at least 1000 of its pixels show (at 640 x 480, "
      "scaled with the area) and it is seen at 75 deg of incidence or less at their middle; "
      "planes that show one that does not count are left out of extraction and tracking "
      "scores; faces of one object or detection group that are one plane to 0.1 mm, with "
      "joints of at most 30 mm, are one true plane";
  if (s.from_frame_planes || s.regions) AddExtractionRules(s, rules);
  if (s.from_frame_planes) AddAssociationRules(s, rules);
  if (s.map) {
    rules["map"] =
        std::string(
            "in the world of the truth by the mean rotation and the mean position of all "
            "matched poses; a map plane belongs to the truth ") +
        (s.from_frame_planes
             ? "of most of its observations, that with most of them is the match"
             : "that is nearest to the middle of its outline (within 20 deg and 50 mm, their "
               "outlines in common), by shared area where offsets agree to 5 mm") +
        "; offset is the rms distance of the true vertices to the map plane; "
        "vertices one to one within 100 mm; normals are oriented; "
        "polygon_iou and polygon_hausdorff_mm: of the hulls of both outlines in the true "
        "plane; "
        "consistency: squared errors of height and slopes at the middle of the outline by the "
        "covariance that the run tells of the plane, whose mean is 3 and of which 0.95 are "
        "inside "
        "where it is honest; silent: beyond 5 of its own standard deviations in some direction";
  }
}

}  // namespace

Json MetricsJson(const Evaluation& e) {
  Json json, reasons = Json::object();
  json["format"] = "pas-metrics/1";
  if (e.interrupted) json["interrupted"] = true;
  if (Json warnings = Warnings(e.run_warnings, "RUN", e.sequence_warnings); !warnings.empty())
    json["warnings"] = std::move(warnings);
  json["trajectory"] = TrajectoryGroup(e.trajectory, reasons);
  if (e.trajectory.consistency)
    json["consistency"] = ConsistencyGroup(*e.trajectory.consistency, reasons);
  if (e.planes) {
    if (e.planes->from_frame_planes || e.planes->regions) {
      json["extraction"] = ExtractionGroup(*e.planes, reasons);
    }
    if (e.planes->from_frame_planes) {
      json["vertices"] = VertexGroup(e.planes->corners, reasons);
      json["association"] = AssociationGroup(*e.planes, reasons);
    }
    if (e.planes->map) json["map"] = MapGroup(*e.planes->map, e.trajectory, reasons);
  }
  for (const std::string& group : e.groups_without_truth) {
    json[group] = nullptr;
    reasons[group] = e.no_planes;
  }
  if (e.timing) json["timing_ms"] = TimingGroup(*e.timing, reasons);
  if (!reasons.empty()) json["reasons"] = std::move(reasons);
  json["rules"] = TrajectoryRules();
  if (e.trajectory.consistency) json["rules"]["consistency"] = kConsistencyRule;
  if (e.planes) AddPlaneRules(*e.planes, json["rules"]);
  return json;
}

Json LabelsJson(const LabelEvaluation& e) {
  Json json, reasons = Json::object();
  json["format"] = "pas-metrics/1";
  Json warnings = Warnings(e.label_warnings, "LABELS", e.sequence_warnings);
  if (!warnings.empty()) json["warnings"] = std::move(warnings);
  json["extraction"] = ExtractionGroup(e.planes, reasons);
  json["reasons"] = std::move(reasons);
  AddPlaneRules(e.planes, json["rules"]);
  return json;
}

std::string MetricsText(const Evaluation& evaluation) {
  return MetricsJson(evaluation).dump(2) + "\n";
}

}  // namespace eval
