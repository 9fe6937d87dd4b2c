// A run that says the truth, and runs that are wrong in one known way each: the figures that
// ought to move do, and no others.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/formats/run/run.h"
#include "eval/formats/sequence/sequence.h"
#include "eval/planes/frame_evidence.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "eval/report/table.h"
#include "tests/eval/report/evaluated_world.h"
#include "tests/eval/tiny_world.h"
#include "tests/support/refusal.h"

namespace eval {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using testing::TinyRun;

namespace fs = std::filesystem;

TEST_F(EvaluateTinyWorld, ARunThatIsTheTruthScoresPerfectly) {
  const nlohmann::json m = Metrics(TinyRun(*world_));
  EXPECT_EQ(m["format"], "pas-metrics/1");
  const auto& t = m["trajectory"];
  EXPECT_EQ(t["frames"], TinyWorld::kFrames);
  EXPECT_EQ(t["tracked"], TinyWorld::kFrames);
  EXPECT_EQ(t["tracked_fraction"], 1.0);
  EXPECT_EQ(t["lost_events"], 0);
  for (const char* key : {"rmse_m", "mean_m", "median_m", "std_m", "max_m"}) {
    EXPECT_NEAR(t["ate_se3"][key].get<double>(), 0.0, kExact) << key;
    EXPECT_NEAR(t["ate_origin"][key].get<double>(), 0.0, kExact) << key;
  }
  EXPECT_NEAR(t["ate_complete_rmse_m"].get<double>(), 0.0, kExact);
  for (const char* key : {"rpe_1s", "rpe_1m"}) {
    EXPECT_GT(t[key]["pairs"].get<int>(), 0) << key;
    EXPECT_NEAR(t[key]["trans_rmse_m"].get<double>(), 0.0, kExact) << key;
    EXPECT_NEAR(t[key]["rot_rmse_deg"].get<double>(), 0.0, 1e-6) << key;
  }
  const auto& x = m["extraction"];
  EXPECT_GT(x["truth"].get<double>(), 3.0);
  EXPECT_EQ(x["truth"], x["machine"]);
  EXPECT_EQ(x["truth"], x["correct"]);
  for (const char* key : {"over", "under", "missed", "noise"}) EXPECT_EQ(x[key], 0.0) << key;
  for (const char* key : {"pq", "sq", "rq", "pixel_precision", "pixel_recall", "correct_ratio",
                          "correct_pixel_ratio", "ri", "sc"}) {
    EXPECT_EQ(x[key], 1.0) << key;
  }
  EXPECT_EQ(x["voi_bits"], 0.0);
  for (const char* key : {"precision", "recall", "f1", "mean_iou", "mean_dice", "panoptic"})
    EXPECT_NEAR(x["evops"][key].get<double>(), 1.0, kExact) << key;
  for (const char* key : {"usr", "osr", "noise", "missed"})
    EXPECT_EQ(x["evops"][key], 0.0) << key;
  EXPECT_NEAR(x["normal_deg"]["p95"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(x["offset_mm"]["p95"].get<double>(), 0.0, kExact_mm);
  for (const char* key : {"precision", "recall", "planes_with_4"}) {
    EXPECT_EQ(m["vertices"][key], 1.0) << key;
  }
  EXPECT_NEAR(m["vertices"]["error_mm"]["p95"].get<double>(), 0.0, kExact_mm);
  const auto& a = m["association"];
  for (const char* group : {"pair", "b_cubed", "decision"}) {
    for (const char* key : {"precision", "recall", "f1"}) {
      EXPECT_NEAR(a[group][key].get<double>(), 1.0, kExact) << group << key;
    }
  }
  for (const char* key : {"fp", "fn", "spurious"}) EXPECT_EQ(a["decision"][key], 0) << key;
  for (const char* key : {"purity", "inverse_purity"})
    EXPECT_NEAR(a[key].get<double>(), 1.0, kExact) << key;
  EXPECT_NEAR(a["voi_bits"].get<double>(), 0.0, kExact);
  for (const char* key : {"idf1", "hota", "ass_a", "mota"}) {
    EXPECT_NEAR(a[key].get<double>(), 1.0, kExact) << key;
  }
  for (const char* key : {"id_switches", "merged_map_planes", "split_truth_planes"}) {
    EXPECT_EQ(a[key], 0) << key;
  }
  const auto& map = m["map"];
  EXPECT_EQ(map["matched"], map["true_planes_seen"]);
  for (const char* key : {"duplicates", "merged", "spurious"}) EXPECT_EQ(map[key], 0) << key;
  EXPECT_NEAR(map["normal_deg"]["p95"].get<double>(), 0.0, 1e-6);
  EXPECT_NEAR(map["offset_mm"]["p95"].get<double>(), 0.0, kExact_mm);
  EXPECT_NEAR(map["vertex_mm"]["p95"].get<double>(), 0.0, kExact_mm);
  EXPECT_NEAR(map["polygon_iou"]["median"].get<double>(), 1.0, kExact);
  EXPECT_NEAR(map["polygon_hausdorff_mm"]["p95"].get<double>(), 0.0, kExact_mm);
  EXPECT_NEAR(map["area_explained"].get<double>(), 1.0, kExact);
  EXPECT_EQ(m["timing_ms"]["mt"]["mean"], 10.0);
  EXPECT_EQ(m["timing_ms"]["fps"], 100.0);
  EXPECT_EQ(m["timing_ms"]["peak_rss_mb"], 128.5);
}

TEST_F(EvaluateTinyWorld, FramesASecondAreThoseOfTheWholeRunSlowFramesToo) {
  TinyRun run(*world_);
  const std::string slow = ",100\n", usual = ",10\n";
  run.timing.replace(run.timing.find(usual), usual.size(), slow);
  const nlohmann::json times = Metrics(run)["timing_ms"];
  EXPECT_EQ(times["mt"]["median"], 10.0);
  EXPECT_NEAR(times["fps"].get<double>(), 45 / (44 * 0.010 + 0.100), kExact);
}

// Five in a hundred of 45 frames are 2.25.
TEST_F(EvaluateTinyWorld, TheLimitOf95PercentPassesOverTwoSlowFramesAndNotOverFour) {
  for (const int slow_frames : {2, 4}) {
    TinyRun run(*world_);
    const std::string usual = ",10\n";
    for (int i = 0; i < slow_frames; ++i)
      run.timing.replace(run.timing.find(usual), usual.size(), ",100\n");
    EXPECT_EQ(Metrics(run)["timing_ms"]["mt"]["p95"], slow_frames == 2 ? 10.0 : 100.0);
  }
}

TEST_F(EvaluateTinyWorld, TheSameFilesGiveTheSameBytes) {
  const TinyRun run(*world_);
  EXPECT_EQ(MetricsText(EvaluationOf(run)), MetricsText(EvaluationOf(run)));
}

TEST_F(EvaluateTinyWorld, ABookPutOnTheDesksMapPlaneMovesAssociationAndMapOnly) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  int moved_decisions = 0;
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (auto* plane = FramePlane(run, i, TinyWorld::kThinTop)) {
      (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
      (*plane)["decision"] = "matched";
      ++moved_decisions;  // also in the frame that makes it: the desk shows more pixels of it
    }
  }
  auto& planes = run.map["planes"];
  planes.erase(std::find_if(planes.begin(), planes.end(), [](const auto& plane) {
    return plane["id"] == TinyRun::MapId(TinyWorld::kThinTop);
  }));
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"association/pair", "association/b_cubed", "association/decision",
                  "association/idf1", "association/hota", "association/ass_a",
                  "association/mota", "association/purity", "association/voi_bits",
                  "association/no_decision", "association/merged_map_planes", "map/planes",
                  "map/matched", "map/merged", "map/consistency", "map/area_explained"}));
  EXPECT_EQ(after["association"]["merged_map_planes"], 1);
  EXPECT_EQ(after["map"]["merged"], 1);
  EXPECT_EQ(after["association"]["decision"]["fp"], moved_decisions);
  EXPECT_EQ(after["association"]["decision"]["fn"], 0);
  EXPECT_EQ(after["association"]["pair"]["recall"], 1.0);
  EXPECT_LT(after["association"]["pair"]["precision"], 1.0);
}

TEST_F(EvaluateTinyWorld, TwoBooksThatSwapIdsForOneFrameCountAsTwoWrongDecisions) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  auto* thick = FramePlane(run, 20, TinyWorld::kThickTop);
  auto* thin = FramePlane(run, 20, TinyWorld::kThinTop);
  ASSERT_TRUE(thick != nullptr && thin != nullptr);
  std::swap((*thick)["map_plane"], (*thin)["map_plane"]);
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"association/pair", "association/b_cubed", "association/decision",
                  "association/idf1", "association/hota", "association/ass_a",
                  "association/purity", "association/inverse_purity", "association/voi_bits",
                  "association/mota", "association/id_switches"}));
  EXPECT_EQ(after["association"]["decision"]["fp"], 2);
  EXPECT_EQ(after["association"]["decision"]["fn"], 2);
  EXPECT_EQ(after["association"]["id_switches"], 4);  // there and back, twice
}

TEST_F(EvaluateTinyWorld, ANewIdForAKnownBookIsMissedByTheGateAndDuplicatesTheMapPlane) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  bool first = true;
  for (std::size_t i = 20; i < run.frames.size(); ++i) {
    if (auto* plane = FramePlane(run, i, TinyWorld::kThickTop)) {
      (*plane)["map_plane"] = 777;
      if (first) (*plane)["decision"] = "new";
      first = false;
    }
  }
  nlohmann::json copy = MapPlane(run, TinyWorld::kThickTop);
  copy["id"] = 777;
  run.map["planes"].push_back(copy);
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(
      Moved(before, after),
      (Keys{"association/pair", "association/b_cubed", "association/decision",
            "association/idf1", "association/hota", "association/ass_a", "association/mota",
            "association/id_switches", "association/inverse_purity", "association/voi_bits",
            "association/split_truth_planes", "map/planes", "map/duplicates"}));
  EXPECT_EQ(after["association"]["decision"]["precision"], 1.0);
  EXPECT_EQ(after["association"]["decision"]["fn"], 1);
  EXPECT_EQ(after["association"]["split_truth_planes"], 1);
  EXPECT_EQ(after["map"]["duplicates"], 1);
}

TEST_F(EvaluateTinyWorld, ADuplicateThatTheMapMergedLaterIsNoDuplicateOfTheFinalMap) {
  TinyRun run(*world_);
  for (std::size_t i = 20; i < 30; ++i) {
    if (auto* plane = FramePlane(run, i, TinyWorld::kThickTop)) (*plane)["map_plane"] = 777;
  }
  nlohmann::json copy = MapPlane(run, TinyWorld::kThickTop);
  copy["id"] = 777;
  copy["merged_into"] = TinyRun::MapId(TinyWorld::kThickTop);
  run.map["planes"].push_back(copy);
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(after["map"]["duplicates"], 0);
  EXPECT_EQ(after["map"]["spurious"], 0);
  EXPECT_EQ(after["association"]["decision"]["fn"], 1);  // the decision stays as it was made
}

TEST_F(EvaluateTinyWorld, DroppedFramesCostCoverageAndTheCompleteErrorButNotTheRest) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  run.trajectory.erase(run.trajectory.begin() + 10, run.trajectory.begin() + 14);
  run.trajectory.erase(run.trajectory.begin() + 30, run.trajectory.begin() + 33);
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"trajectory/tracked", "trajectory/tracked_fraction", "trajectory/lost_events",
                  "trajectory/ate_complete_rmse_m", "trajectory/rpe_1s", "trajectory/rpe_1m"}));
  EXPECT_EQ(after["trajectory"]["tracked"], TinyWorld::kFrames - 7);
  EXPECT_EQ(after["trajectory"]["lost_events"], 2);
  EXPECT_LT(after["trajectory"]["rpe_1s"]["pairs"], before["trajectory"]["rpe_1s"]["pairs"]);
  EXPECT_NEAR(after["trajectory"]["rpe_1s"]["trans_rmse_m"].get<double>(), 0.0, kExact);
  EXPECT_GT(after["trajectory"]["ate_complete_rmse_m"].get<double>(), 0.1);
}

TEST_F(EvaluateTinyWorld, AnotherWorldOriginMovesNothing) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  const Pose T_vw{Eigen::AngleAxisd(2.0, Eigen::Vector3d::UnitY()).toRotationMatrix(),
                  Eigen::Vector3d(3, -4, 5)};
  for (auto& [stamp_s, T_wc] : run.trajectory) T_wc = T_vw * T_wc;
  for (auto& plane : run.map["planes"]) {
    const auto vector = [](const nlohmann::json& v) {
      return Eigen::Vector3d(v[0].get<double>(), v[1].get<double>(), v[2].get<double>());
    };
    const Plane pi_v = Transform(T_vw, {vector(plane["normal"]), plane["d"].get<double>()});
    plane["normal"] = testing::ToJson(pi_v.n);
    plane["d"] = pi_v.d;
    for (const char* key : {"vertices", "hull"}) {
      for (auto& point : plane[key]) {
        point = testing::ToJson(Eigen::Vector3d(T_vw * vector(point)));
      }
    }
  }
  EXPECT_EQ(Moved(before, Metrics(run)), Keys{});
}

TEST_F(EvaluateTinyWorld, ATrajectoryShiftedHalfWayMovesItsErrorsAndTheMapsGauge) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  for (std::size_t i = 20; i < run.trajectory.size(); ++i) {
    run.trajectory[i].second.t += Eigen::Vector3d(0.02, 0.01, 0.0);
  }
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"trajectory/ate_se3", "trajectory/ate_origin",
                  "trajectory/ate_complete_rmse_m", "trajectory/rpe_1s", "trajectory/rpe_1m",
                  "map/offset_mm", "map/vertex_mm", "map/consistency", "map/polygon_iou",
                  "map/polygon_hausdorff_mm", "map/area_explained"}));
  EXPECT_NEAR(after["trajectory"]["ate_origin"]["max_m"].get<double>(), std::hypot(0.02, 0.01),
              kExact);
}

TEST_F(EvaluateTinyWorld, TheTableOfARunHasItsErrorsUnderTheirNames) {
  TinyRun run(*world_);
  for (std::size_t i = 0; i < run.trajectory.size(); i += 3)
    run.trajectory[i].second.t.z() += 0.02 + 0.001 * static_cast<double>(i);
  const Evaluation evaluation = EvaluationOf(run);
  const Statistics& errors = *evaluation.trajectory.ate_se3;
  ASSERT_GT(std::abs(errors.median - errors.mean), 1e-3);
  const std::string expected =
      fmt::format("{:.2f} mm (median {:.2f}, max {:.2f})", 1e3 * errors.rmse,
                  1e3 * errors.median, 1e3 * errors.max);
  EXPECT_NE(MetricsTable(evaluation).find(expected), std::string::npos) << expected;
}

// The number of a frame is its place in the sequence, also where earlier ones have no true pose.
TEST_F(EvaluateTinyWorld, FramesAreNumberedAsInTheSequence) {
  Sequence sequence = ReadSequence(*folder_ / "SEQ");
  ASSERT_GT(sequence.groundtruth->size(), 6u);
  sequence.groundtruth->erase(sequence.groundtruth->begin(), sequence.groundtruth->begin() + 3);
  std::vector<int> numbers;
  VisitEvidence({}, sequence, [&](const FrameEvidence& e) { numbers.push_back(e.number); });
  ASSERT_EQ(numbers.size(), sequence.frames.size() - 3);
  EXPECT_EQ(numbers.front(), 3);
  EXPECT_EQ(numbers.back(), static_cast<int>(sequence.frames.size()) - 1);
}

TEST_F(EvaluateTinyWorld, AFewNoisyPositionsDoNotTiltTheMap) {
  for (const std::size_t count : {6u, 12u, 30u}) {
    TinyRun run(*world_);
    run.trajectory.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      run.trajectory[i].second.t +=
          0.01 * Eigen::Vector3d(std::sin(1.0 * double(i)), std::sin(2.0 * double(i)),
                                 std::sin(3.0 * double(i)));
    }
    const nlohmann::json map = Metrics(run)["map"];
    EXPECT_LT(map["normal_deg"]["p95"].get<double>(), 1e-6) << count;
    EXPECT_LT(map["offset_mm"]["p95"].get<double>(), 10.0) << count;
  }
}

TEST_F(EvaluateTinyWorld, ARunWithoutPosesHasNoErrorOfZero) {
  TinyRun run(*world_);
  run.trajectory.clear();
  const Evaluation evaluation = EvaluationOf(run);
  EXPECT_EQ(evaluation.trajectory.tracked, 0u);
  const nlohmann::json m = nlohmann::json::parse(MetricsText(evaluation));
  EXPECT_TRUE(m["trajectory"].at("ate_se3").is_null());
  EXPECT_TRUE(m["trajectory"].at("ate_origin").is_null());
  for (const char* key :
       {"normal_deg", "offset_mm", "vertex_mm", "polygon_iou", "polygon_hausdorff_mm"}) {
    EXPECT_TRUE(m["map"].at(key).is_null()) << key;
    EXPECT_EQ(m["reasons"].at(std::string("map/") + key), "the run has no pose");
  }
  EXPECT_GT(m["trajectory"]["ate_complete_rmse_m"].get<double>(), 1.0);  // all frames charged
  EXPECT_EQ(m["reasons"]["trajectory/ate_se3"], "the run has no pose");
  EXPECT_THAT(MetricsTable(evaluation), HasSubstr("-  (the run has no pose)"));
}

TEST_F(EvaluateTinyWorld, TheTableSaysWhyAFigureOfTheTrajectoryIsMissing) {
  Evaluation evaluation = EvaluationOf(TinyRun(*world_));
  evaluation.trajectory.rpe_1s.reset();
  evaluation.trajectory.ate_complete_rmse_m.reset();
  evaluation.trajectory.no_ate_complete = "no frame has a true pose";
  const std::string table = MetricsTable(evaluation);
  EXPECT_THAT(table, HasSubstr("ATE, missing charged       -  (no frame has a true pose)"));
  EXPECT_THAT(table,
              HasSubstr("RPE over 1 s               -  (no two matched poses are 1 s apart)"));
}

TEST_F(EvaluateTinyWorld, APoseForAFrameThatDoesNotExistIsRefused) {
  TinyRun run(*world_);
  run.trajectory.emplace_back(99.5, Pose{});
  EXPECT_THAT(test_support::RefusalOf([&] { EvaluationOf(run); }),
              AllOf(HasSubstr("trajectory.txt"), HasSubstr("99.5")));
}

TEST_F(EvaluateTinyWorld, ASequenceWithoutTruthOfPlanesGivesTrajectoryAndTimeOnly) {
  const fs::path bare = *folder_ / "BARE";
  fs::create_directories(bare);
  for (const char* name : {"associations.txt", "groundtruth.txt"}) {
    fs::copy_file(SequenceFolder() / name, bare / name, fs::copy_options::overwrite_existing);
  }
  TinyRun(*world_).Write(RunFolder());
  const nlohmann::json m =
      nlohmann::json::parse(MetricsText(Evaluate(ReadRun(RunFolder()), ReadSequence(bare))));
  EXPECT_TRUE(m.contains("trajectory"));
  EXPECT_TRUE(m.contains("timing_ms"));
  EXPECT_FALSE(m.contains("association"));
  EXPECT_FALSE(m.contains("extraction"));
  EXPECT_FALSE(m.contains("vertices"));
  EXPECT_FALSE(m.contains("map"));
}

TEST_F(EvaluateTinyWorld, TheTableNamesTheHeadlineFiguresAndEveryModule) {
  const std::string table = MetricsTable(EvaluationOf(TinyRun(*world_)));
  for (const char* text : {"ATE rmse", "decision precision", "decision recall", "normal error",
                           "vertex error", "orb", "mt", "45 of 45"}) {
    EXPECT_THAT(table, HasSubstr(text));
  }
}

}  // namespace
}  // namespace eval
