// Reference figures for decisions, tracking scores and segmentation scores.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "eval/planes/association.h"
#include "eval/planes/clear_score.h"
#include "eval/planes/evops_score.h"
#include "eval/planes/hota_score.h"
#include "eval/planes/identity_score.h"
#include "eval/planes/partition_score.h"
#include "eval/planes/segmentation_score.h"
#include "io/json_field.h"
#include "io/text_table.h"
#include "tests/support/shared_data.h"

namespace eval {
namespace {

// Sums of a few hundred terms near 1: 1e3 * 2^-53.
constexpr double kRoundOff = 1e-12;

std::vector<io::TextRecord> ReadCells(const std::filesystem::path& file, bool header) {
  std::vector<io::TextRecord> lines = io::ReadCommaRecords(file);
  if (header) lines.erase(lines.begin());
  return lines;
}

TEST(GoldenAssociation, AgreesOnPairsBCubedDecisionsAndMapPlanes) {
  const std::filesystem::path folder = test_support::SharedFolder() / "golden/association";
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "association_golden.json");
  ASSERT_FALSE(golden["cases"].empty());
  for (const auto& [name, expected] : golden["cases"].items()) {
    SCOPED_TRACE(name);
    const std::filesystem::path file = folder / (name + ".csv");
    std::vector<AssociationRecord> records;
    for (const io::TextRecord& line : ReadCells(file, true)) {
      records.push_back({int(line.Number(0, "cell")), int(line.Number(1, "cell")),
                         int(line.Number(2, "cell"))});
    }
    const AssociationScore s = ScoreAssociation(records);
    EXPECT_EQ(s.records, expected["n_det"].get<std::size_t>());
    EXPECT_EQ(s.records_with_truth, expected["n_det_with_gt"].get<std::size_t>());
    EXPECT_EQ(s.pair_tp, expected["pair_tp"].get<long long>());
    EXPECT_EQ(s.pair_predicted, expected["pair_pred"].get<long long>());
    EXPECT_EQ(s.pair_truth, expected["pair_gt"].get<long long>());
    EXPECT_NEAR(s.pair.precision, expected["pair_precision"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.pair.recall, expected["pair_recall"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.pair.f1, expected["pair_f1"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.b_cubed.precision, expected["b3_precision"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.b_cubed.recall, expected["b3_recall"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.b_cubed.f1, expected["b3_f1"].get<double>(), kRoundOff);
    const auto& decision = expected["decision"];
    EXPECT_EQ(s.decision.tp, decision["TP"].get<int>());
    EXPECT_EQ(s.decision.fp, decision["FP"].get<int>());
    EXPECT_EQ(s.decision.fn, decision["FN"].get<int>());
    EXPECT_EQ(s.decision.tn, decision["TN"].get<int>());
    EXPECT_EQ(s.decision.spurious, decision["spurious_new"].get<int>());
    EXPECT_NEAR(s.decision.scores.precision, decision["precision"].get<double>(), kRoundOff);
    EXPECT_NEAR(s.decision.scores.recall, decision["recall"].get<double>(), kRoundOff);
    const auto& mixed = expected["map_level_min3_5pct"];
    EXPECT_EQ(s.merged_map_planes, mixed["merged_map_planes"].get<int>());
    EXPECT_EQ(s.split_truth_planes, mixed["split_gt_planes"].get<int>());
    const auto& any = expected["map_level_any"];
    const AssociationScore lenient = ScoreAssociation(records, {1.0, 0.0});
    EXPECT_EQ(lenient.merged_map_planes, any["merged_map_planes"].get<int>());
    EXPECT_EQ(lenient.split_truth_planes, any["split_gt_planes"].get<int>());
    const PartitionScore& p = s.partition;
    EXPECT_NEAR(p.purity, expected["purity"].get<double>(), kRoundOff);
    EXPECT_NEAR(p.inverse_purity, expected["inverse_purity"].get<double>(), kRoundOff);
    EXPECT_NEAR(p.truth_given_machine_bits, expected["H_gt_given_map_bits"].get<double>(),
                kRoundOff);
    EXPECT_NEAR(p.machine_given_truth_bits, expected["H_map_given_gt_bits"].get<double>(),
                kRoundOff);
    EXPECT_NEAR(p.VoiBits(), expected["voi_bits"].get<double>(), kRoundOff);
  }
}

std::vector<TrackingFrame> ReadTracking(const std::filesystem::path& file, std::size_t count) {
  struct Rows {
    std::set<int> truths, predictions;
    std::map<std::pair<int, int>, double> similarity;
  };
  std::vector<Rows> rows(count);
  for (const io::TextRecord& line : ReadCells(file, true)) {
    Rows& row = rows[std::size_t(line.Number(0, "cell"))];
    const int truth = int(line.Number(1, "cell")), predicted = int(line.Number(2, "cell"));
    if (truth >= 0) row.truths.insert(truth);
    if (predicted >= 0) row.predictions.insert(predicted);
    if (truth >= 0 && predicted >= 0)
      row.similarity[{truth, predicted}] = line.Number(3, "cell");
  }
  std::vector<TrackingFrame> frames;
  for (const Rows& row : rows) {
    TrackingFrame frame;
    frame.truth_ids.assign(row.truths.begin(), row.truths.end());
    frame.predicted_ids.assign(row.predictions.begin(), row.predictions.end());
    frame.similarity = Eigen::MatrixXd::Zero(Eigen::Index(frame.truth_ids.size()),
                                             Eigen::Index(frame.predicted_ids.size()));
    for (std::size_t i = 0; i < frame.truth_ids.size(); ++i) {
      for (std::size_t j = 0; j < frame.predicted_ids.size(); ++j) {
        const auto found = row.similarity.find({frame.truth_ids[i], frame.predicted_ids[j]});
        if (found == row.similarity.end()) continue;
        frame.similarity(Eigen::Index(i), Eigen::Index(j)) = found->second;
      }
    }
    frames.push_back(frame);
  }
  return frames;
}

void ExpectNear(double ours, const nlohmann::json& golden, const std::string& key) {
  EXPECT_NEAR(ours, golden[key].get<double>(), kRoundOff) << key;
}

void ExpectClear(const ClearScore& s, const nlohmann::json& golden) {
  EXPECT_EQ(s.tp, golden["CLR_TP"].get<int>());
  EXPECT_EQ(s.fp, golden["CLR_FP"].get<int>());
  EXPECT_EQ(s.fn, golden["CLR_FN"].get<int>());
  EXPECT_EQ(s.id_switches, golden["IDSW"].get<int>());
  EXPECT_EQ(s.mostly_tracked, golden["MT"].get<int>());
  EXPECT_EQ(s.partly_tracked, golden["PT"].get<int>());
  EXPECT_EQ(s.mostly_lost, golden["ML"].get<int>());
  EXPECT_EQ(s.fragmentations, golden["Frag"].get<int>());
  ExpectNear(s.mota, golden, "MOTA");
  ExpectNear(s.motp, golden, "MOTP");
  ExpectNear(s.moda, golden, "MODA");
  ExpectNear(s.smota, golden, "sMOTA");
  ExpectNear(s.motal, golden, "MOTAL");
  ExpectNear(s.recall, golden, "CLR_Re");
  ExpectNear(s.precision, golden, "CLR_Pr");
  ExpectNear(s.f1, golden, "CLR_F1");
  EXPECT_NEAR(s.similarity_sum, golden["MOTP_sum"].get<double>(), 1e-9);  // some 200 terms
  const double truths = s.mostly_tracked + s.partly_tracked + s.mostly_lost;
  ExpectNear(s.mostly_tracked / truths, golden, "MTR");
  ExpectNear(s.partly_tracked / truths, golden, "PTR");
  ExpectNear(s.mostly_lost / truths, golden, "MLR");
  ExpectNear(double(s.fp) / s.frames, golden, "FP_per_frame");
  // TrackEval leaves before it counts where nothing was predicted at all.
  if (s.tp + s.fp > 0) {
    EXPECT_EQ(s.frames, golden["CLR_Frames"].get<int>());
  }
}

/// @param value  picks a figure of the reference: of one threshold, or the mean
template <typename Pick>
void ExpectHota(const HotaFigures& s, const Pick& value) {
  const std::map<std::string, double> ours = {
      {"HOTA", s.hota},           {"DetA", s.det_a},          {"AssA", s.ass_a},
      {"DetRe", s.det_recall},    {"DetPr", s.det_precision}, {"AssRe", s.ass_recall},
      {"AssPr", s.ass_precision}, {"LocA", s.loc_a},          {"OWTA", s.owta}};
  for (const auto& [key, figure] : ours) EXPECT_NEAR(figure, value(key), kRoundOff) << key;
}

TEST(GoldenTrackEval, AgreesOnEveryFigureOfClearIdentityAndHota) {
  const std::filesystem::path folder = test_support::SharedFolder() / "golden/trackeval";
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "trackeval_golden.json");
  ASSERT_FALSE(golden["cases"].empty());
  for (const auto& [name, expected] : golden["cases"].items()) {
    SCOPED_TRACE(name);
    const std::vector<TrackingFrame> frames =
        ReadTracking(folder / (name + ".csv"), expected["n_frames"].get<std::size_t>());
    ExpectClear(ScoreClear(frames), expected["CLEAR"]);
    const IdentityScore identity = ScoreIdentity(frames);
    EXPECT_EQ(identity.idtp, expected["Identity"]["IDTP"].get<int>());
    EXPECT_EQ(identity.idfp, expected["Identity"]["IDFP"].get<int>());
    EXPECT_EQ(identity.idfn, expected["Identity"]["IDFN"].get<int>());
    ExpectNear(identity.idf1, expected["Identity"], "IDF1");
    ExpectNear(identity.idp, expected["Identity"], "IDP");
    ExpectNear(identity.idr, expected["Identity"], "IDR");
    const HotaScore hota = ScoreHota(frames);
    ExpectHota(hota, [&, &figures = expected](const std::string& key) {
      return figures["HOTA_mean_over_alpha"][key].get<double>();
    });
    for (std::size_t a = 0; a < hota.at.size(); ++a) {
      SCOPED_TRACE(golden["meta"]["alphas"][a]);
      const auto at = [&, &figures = expected](const std::string& key) {
        return figures["HOTA"][key][a].get<double>();
      };
      ExpectHota(hota.at[a], at);
      EXPECT_EQ(hota.at[a].tp, at("HOTA_TP"));
      EXPECT_EQ(hota.at[a].fn, at("HOTA_FN"));
      EXPECT_EQ(hota.at[a].fp, at("HOTA_FP"));
    }
    const HotaFigures& lowest = hota.at.front();
    ExpectNear(lowest.hota, expected["HOTA"], "HOTA(0)");
    ExpectNear(lowest.loc_a, expected["HOTA"], "LocA(0)");
    ExpectNear(lowest.hota * lowest.loc_a, expected["HOTA"], "HOTALocA(0)");
    EXPECT_EQ(lowest.tp + lowest.fn, expected["Count"]["GT_Dets"].get<double>());
    EXPECT_EQ(lowest.tp + lowest.fp, expected["Count"]["Dets"].get<double>());
  }
}

cv::Mat1w ReadLabelTable(const std::filesystem::path& file) {
  const std::vector<io::TextRecord> lines = ReadCells(file, false);
  cv::Mat1w labels(int(lines.size()), int(lines.front().fields.size()));
  for (int y = 0; y < labels.rows; ++y) {
    for (int x = 0; x < labels.cols; ++x) {
      labels(y, x) =
          static_cast<std::uint16_t>(lines[std::size_t(y)].Number(std::size_t(x), "cell"));
    }
  }
  return labels;
}

void ExpectHoover(const HooverScore& hoover, const nlohmann::json& counts) {
  EXPECT_EQ(hoover.truth, counts["n_gt"].get<int>());
  EXPECT_EQ(hoover.machine, counts["n_ms"].get<int>());
  EXPECT_EQ(hoover.correct, counts["n_correct"].get<int>());
  EXPECT_EQ(hoover.over, counts["n_over"].get<int>());
  EXPECT_EQ(hoover.under, counts["n_under"].get<int>());
  EXPECT_EQ(hoover.missed, counts["n_missed"].get<int>());
  EXPECT_EQ(hoover.noise, counts["n_noise"].get<int>());
}

/// A port of Hoover's compare.c, which asks for more than the share.
void ExpectSegComp(const HooverScore& strict, const nlohmann::json& golden) {
  ExpectNear(strict.truth, golden, "n_gt");
  ExpectNear(strict.machine, golden, "n_ms_all");
  ExpectNear(strict.correct, golden, "n_corr_seg");
  ExpectNear(strict.over, golden, "n_over_seg");
  ExpectNear(strict.under, golden, "n_under_seg");
  ExpectNear(strict.missed, golden, "n_missed_seg");
  ExpectNear(strict.noise, golden, "n_noise_seg");
  ExpectNear(double(strict.correct) / strict.truth, golden, "f_corr_seg");
  ExpectNear(double(strict.correct_pixels) / double(strict.truth_pixels), golden,
             "f_weighted_corr_seg");
}

void ExpectEvops(const EvopsScore& s, const nlohmann::json& golden) {
  for (const char* by : {"iou", "dice"}) {
    const auto& g = golden[by];
    ExpectNear(s.precision, g, "precision");
    ExpectNear(s.recall, g, "recall");
    ExpectNear(s.f1, g, "fScore");
    ExpectNear(s.under_ratio, g, "usr");
    ExpectNear(s.over_ratio, g, "osr");
    ExpectNear(s.noise_ratio, g, "noise");
    ExpectNear(s.missed_ratio, g, "missed");
  }
  ExpectNear(s.mean_iou, golden["iou"], "mean");
  ExpectNear(s.panoptic, golden["iou"], "panoptic");
  ExpectNear(s.mean_dice, golden["dice"], "mean");
  ExpectNear(s.mean_dice * s.f1, golden["dice"], "panoptic");
}

TEST(GoldenSegmentation, AgreesOnEveryFigureThatIsAdopted) {
  const std::filesystem::path folder = test_support::SharedFolder() / "golden/segmentation";
  SKIP_WITHOUT(folder);
  const nlohmann::json golden = io::ReadJson(folder / "segmentation_golden.json");
  ASSERT_FALSE(golden["cases"].empty());
  for (const auto& [name, expected] : golden["cases"].items()) {
    SCOPED_TRACE(name);
    const LabelPairs pairs = CountPairs(ReadLabelTable(folder / (name + "_gt.csv")),
                                        ReadLabelTable(folder / (name + "_pred.csv")));
    const Overlap overlap = OverlapOf(pairs);
    ExpectHoover(ScoreHoover(overlap), expected["hoover_T80_ge"]);
    // More than the share: shares of some hundred pixels lie farther apart than this.
    const HooverScore strict = ScoreHoover(overlap, kHooverShare + 1e-9);
    ExpectHoover(strict, expected["hoover_T80_gt"]);
    ExpectSegComp(strict, expected["polylidar_evaluate"]);
    const PanopticCounts panoptic = CountPanoptic(overlap);
    EXPECT_EQ(panoptic.tp, expected["PQ"]["TP"].get<int>());
    EXPECT_EQ(panoptic.fp, expected["PQ"]["FP"].get<int>());
    EXPECT_EQ(panoptic.fn, expected["PQ"]["FN"].get<int>());
    EXPECT_NEAR(panoptic.Pq(), expected["PQ"]["PQ"].get<double>(), kRoundOff);
    EXPECT_NEAR(panoptic.Sq(), expected["PQ"]["SQ"].get<double>(), kRoundOff);
    EXPECT_NEAR(panoptic.Rq(), expected["PQ"]["RQ"].get<double>(), kRoundOff);
    const PartitionScore partition = ScorePartition(pairs);
    ExpectNear(partition.rand_index, expected["clustering_with_background"], "RI");
    ExpectNear(partition.VoiBits(), expected["clustering_with_background"], "VOI_bits");
    ExpectNear(partition.covering, expected["clustering_with_background"], "SC");
    ExpectEvops(ScoreEvops(overlap), expected["evops_1.0_full_statistics_IoU0.75_part0.2"]);
  }
}

}  // namespace
}  // namespace eval
