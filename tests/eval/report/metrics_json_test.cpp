#include "eval/report/metrics_json.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace eval {
namespace {

struct Told {
  std::string key;  ///< JSON pointer
  double value;
};

/// Planes whose every figure is a number of its own.
PlaneScore PlanesOfDistinctFigures() {
  PlaneScore planes;
  planes.by_pixels = true;
  RegionScore& r = planes.regions.emplace();
  r.truth = 5.1, r.machine = 5.2, r.correct = 5.3, r.over = 5.4, r.under = 5.5;
  r.missed = 5.6, r.noise = 5.7;
  r.correct_ratio = 0.11, r.correct_pixel_ratio = 0.12;
  r.pixel_precision = 0.13, r.pixel_recall = 0.14;
  r.rand_index = 0.15, r.voi_bits = 1.6, r.covering = 0.17;
  r.panoptic = {8, 4, 0, 6.0};
  r.evops = {0.21, 0.22, 0.23, 0.24, 0.25, 0.26, 0.27, 0.28, 0.29, 0.31};
  planes.normal_deg = {1.25, 2.25};
  planes.offset_mm = {3.25, 4.25};
  CornerCounts& c = planes.corners;
  c.claimed = 40, c.matched = 30, c.true_in_view = 50, c.found_in_view = 20;
  c.faces_in_view = 16, c.faces_with_4 = 5;
  c.errors_mm = {6.25};
  AssociationScore& a = planes.association;
  a.records = a.records_with_truth = 99;
  a.pair_tp = 1, a.pair_predicted = 2, a.pair_truth = 3;
  a.pair = {0.32, 0.33, 0.34}, a.b_cubed = {0.35, 0.36, 0.37};
  a.partition.purity = 0.38, a.partition.inverse_purity = 0.39;
  a.partition.truth_given_machine_bits = 0.5, a.partition.machine_given_truth_bits = 0.25;
  a.decision.tp = 61, a.decision.fp = 62, a.decision.fn = 63, a.decision.tn = 64;
  a.decision.spurious = 65, a.decision.scores = {0.41, 0.42, 0.43};
  a.merged_map_planes = 66, a.split_truth_planes = 67;
  planes.identity.idtp = 1, planes.identity.idf1 = 0.44;
  planes.identity.idp = 0.45, planes.identity.idr = 0.46;
  planes.hota.hota = 0.47, planes.hota.ass_a = 0.48, planes.hota.det_a = 0.49;
  planes.hota.loc_a = 0.51;
  planes.clear.tp = 1, planes.clear.mota = 0.52, planes.clear.motp = 0.53;
  planes.clear.moda = 0.54, planes.clear.id_switches = 68;
  planes.undecided.large = 12;
  planes.undecided.undecided.resize(3);
  planes.history.says_by = true;
  planes.ambiguous.resize(7);
  MapScore& m = planes.map.emplace();
  m.planes = 71, m.true_planes_seen = 72, m.matched = 73, m.duplicates = 74, m.merged = 75;
  m.spurious = 76;
  m.normal_deg = {1.75, 2.75}, m.offset_mm = {3.75, 4.75}, m.vertex_mm = {5.75, 6.75};
  m.polygon_iou_median = 0.55, m.polygon_hausdorff_mm = {7.75, 8.75};
  m.area_explained = 0.56;
  return planes;
}

const std::vector<Told> kTold = {
    {"/extraction/truth", 5.1},
    {"/extraction/machine", 5.2},
    {"/extraction/correct", 5.3},
    {"/extraction/over", 5.4},
    {"/extraction/under", 5.5},
    {"/extraction/missed", 5.6},
    {"/extraction/noise", 5.7},
    {"/extraction/pq", 0.6},  // of 8 found, 6 in common, and 4 too many
    {"/extraction/sq", 0.75},
    {"/extraction/rq", 0.8},
    {"/extraction/correct_ratio", 0.11},
    {"/extraction/correct_pixel_ratio", 0.12},
    {"/extraction/pixel_precision", 0.13},
    {"/extraction/pixel_recall", 0.14},
    {"/extraction/ri", 0.15},
    {"/extraction/voi_bits", 1.6},
    {"/extraction/sc", 0.17},
    {"/extraction/evops/precision", 0.21},
    {"/extraction/evops/recall", 0.22},
    {"/extraction/evops/f1", 0.23},
    {"/extraction/evops/mean_iou", 0.24},
    {"/extraction/evops/mean_dice", 0.25},
    {"/extraction/evops/panoptic", 0.26},
    {"/extraction/evops/usr", 0.27},
    {"/extraction/evops/osr", 0.28},
    {"/extraction/evops/noise", 0.29},
    {"/extraction/evops/missed", 0.31},
    {"/extraction/normal_deg/median", 1.25},
    {"/extraction/normal_deg/p95", 2.25},
    {"/extraction/offset_mm/median", 3.25},
    {"/extraction/offset_mm/p95", 4.25},
    {"/vertices/precision", 0.75},
    {"/vertices/recall", 0.4},
    {"/vertices/planes_with_4", 0.3125},
    {"/vertices/error_mm/median", 6.25},
    {"/association/pair/precision", 0.32},
    {"/association/pair/recall", 0.33},
    {"/association/pair/f1", 0.34},
    {"/association/b_cubed/precision", 0.35},
    {"/association/b_cubed/recall", 0.36},
    {"/association/b_cubed/f1", 0.37},
    {"/association/purity", 0.38},
    {"/association/inverse_purity", 0.39},
    {"/association/voi_bits", 0.75},
    {"/association/decision/tp", 61},
    {"/association/decision/fp", 62},
    {"/association/decision/fn", 63},
    {"/association/decision/tn", 64},
    {"/association/decision/spurious", 65},
    {"/association/decision/precision", 0.41},
    {"/association/decision/recall", 0.42},
    {"/association/decision/f1", 0.43},
    {"/association/decision/ambiguous", 7},
    {"/association/merged_map_planes", 66},
    {"/association/split_truth_planes", 67},
    {"/association/idf1", 0.44},
    {"/association/hota", 0.47},
    {"/association/ass_a", 0.48},
    {"/association/mota", 0.52},
    {"/association/id_switches", 68},
    {"/association/no_decision/share", 0.25},
    {"/association/no_decision/events", 3},
    {"/association/no_decision/surfaces", 12},
    {"/map/planes", 71},
    {"/map/true_planes_seen", 72},
    {"/map/matched", 73},
    {"/map/duplicates", 74},
    {"/map/merged", 75},
    {"/map/spurious", 76},
    {"/map/normal_deg/median", 1.75},
    {"/map/normal_deg/p95", 2.75},
    {"/map/offset_mm/median", 3.75},
    {"/map/offset_mm/p95", 4.75},
    {"/map/vertex_mm/median", 5.75},
    {"/map/vertex_mm/p95", 6.75},
    {"/map/polygon_iou/median", 0.55},
    {"/map/polygon_hausdorff_mm/median", 7.75},
    {"/map/polygon_hausdorff_mm/p95", 8.75},
    {"/map/area_explained", 0.56},
    {"/trajectory/frames", 81},
    {"/trajectory/tracked", 27},
    {"/trajectory/tracked_fraction", 27.0 / 81},
    {"/trajectory/lost_events", 83},
    {"/trajectory/ate_se3/rmse_m", 1.1},
    {"/trajectory/ate_se3/mean_m", 1.2},
    {"/trajectory/ate_se3/median_m", 1.3},
    {"/trajectory/ate_se3/std_m", 1.4},
    {"/trajectory/ate_se3/max_m", 1.5},
    {"/trajectory/ate_origin/rmse_m", 2.1},
    {"/trajectory/ate_complete_rmse_m", 3.1},
    {"/trajectory/rpe_1s/trans_rmse_m", 4.1},
    {"/trajectory/rpe_1s/rot_rmse_deg", 4.2},
    {"/trajectory/rpe_1s/pairs", 84},
    {"/trajectory/rpe_1m/trans_rmse_m", 4.3},
    {"/trajectory/rpe_1m/rot_rmse_deg", 4.4},
    {"/trajectory/rpe_1m/pairs", 85},
};

TEST(MetricsJson, TellsEachFigureUnderItsOwnName) {
  Evaluation evaluation;
  TrajectoryScore& t = evaluation.trajectory;
  t.frames = 81, t.tracked = 27, t.lost_events = 83;
  t.gauge = Alignment{};
  Statistics& ate = t.ate_se3.emplace();
  ate.rmse = 1.1, ate.mean = 1.2, ate.median = 1.3, ate.std_dev = 1.4, ate.max = 1.5;
  t.ate_origin.emplace().rmse = 2.1;
  t.ate_complete_rmse_m = 3.1;
  t.rpe_1s = {4.1, 4.2, 84}, t.rpe_1m = {4.3, 4.4, 85};
  evaluation.planes = PlanesOfDistinctFigures();
  const nlohmann::json json = MetricsJson(evaluation);
  std::set<std::string> told;
  for (const auto& [key, value] : kTold) {
    const nlohmann::json::json_pointer pointer(key);
    ASSERT_TRUE(json.contains(pointer)) << key;
    EXPECT_NEAR(json[pointer].get<double>(), value, 1e-12) << key;
    told.insert(key);
  }
  // No figure of planes is left out here.
  const nlohmann::json flat = json.flatten();
  for (const auto& [key, value] : flat.items()) {
    const std::string group = key.substr(1, key.find('/', 1) - 1);
    if (group != "extraction" && group != "association" && group != "map") continue;
    EXPECT_TRUE(!value.is_number() || told.count(key) == 1) << key;
  }
}

}  // namespace
}  // namespace eval
