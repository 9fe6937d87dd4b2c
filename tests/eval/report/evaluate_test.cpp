// A run that says the truth, and runs that are wrong in one known way each: the figures that
// ought to move do, and no others.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include "eval/read/input_error.h"
#include "eval/read/run.h"
#include "eval/read/sequence.h"
#include "eval/read/text_table.h"
#include "eval/report/evaluate.h"
#include "eval/report/metrics_json.h"
#include "eval/report/table.h"
#include "tests/eval/tiny_world.h"

namespace eval {
namespace {

using ::testing::HasSubstr;
using testing::TinyRun;
using testing::TinyWorld;

namespace fs = std::filesystem;

// Positions below 2 m through a dozen rigid motions and one alignment, in metres and degrees;
// millimetres are a thousand times that. Seventeen digits of text lose nothing.
constexpr double kExact = 1e-9;
constexpr double kExact_mm = 1e-6;

class EvaluateTinyWorld : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    world_ = new TinyWorld;
    folder_ = new fs::path(fs::path(::testing::TempDir()) /
                           ("pas_eval_" + std::to_string(::getpid())));
    world_->WriteSequence(*folder_ / "SEQ");
  }
  static void TearDownTestSuite() {
    fs::remove_all(*folder_);
    delete folder_;
    delete world_;
  }

  static fs::path SequenceFolder() { return *folder_ / "SEQ"; }
  static fs::path RunFolder() { return *folder_ / "RUN"; }

  static Evaluation EvaluationOf(const TinyRun& tiny) {
    tiny.Write(RunFolder());
    const eval::Run run = ReadRun(RunFolder());
    return Evaluate(run, ReadSequence(SequenceOf(run)));
  }
  static nlohmann::json Metrics(const TinyRun& tiny) {
    return nlohmann::json::parse(MetricsText(EvaluationOf(tiny)));
  }

  /// Groups and keys of metrics.json whose figures differ from those of the perfect run, at the
  /// depth of "group/key".
  static std::set<std::string> Moved(const nlohmann::json& before,
                                     const nlohmann::json& after) {
    std::set<std::string> moved;
    for (const auto* one : {&before, &after}) {
      for (const auto& [group, keys] : one->items()) {
        if (group == "rules" || group == "format") continue;
        for (const auto& [key, value] : keys.items()) {
          const auto path = nlohmann::json::json_pointer("/" + group + "/" + key);
          if (!Same(before.contains(path) ? before[path] : nlohmann::json(),
                    after.contains(path) ? after[path] : nlohmann::json())) {
            moved.insert(group + "/" + key);
          }
        }
      }
    }
    return moved;
  }

  static bool Same(const nlohmann::json& a, const nlohmann::json& b) {
    if (a.is_number() && b.is_number()) {
      return std::abs(a.get<double>() - b.get<double>()) < kExact_mm;
    }
    if (!a.is_object() || !b.is_object()) return a == b;
    if (a.size() != b.size()) return false;
    for (const auto& [key, value] : a.items()) {
      if (!b.contains(key) || !Same(value, b[key])) return false;
    }
    return true;
  }

  static nlohmann::json* FramePlane(TinyRun& run, std::size_t frame, int truth) {
    for (auto& plane : run.frames[frame]["planes"]) {
      if (plane["map_plane"] == TinyRun::MapId(truth)) return &plane;
    }
    return nullptr;
  }
  static nlohmann::json& MapPlane(TinyRun& run, int truth) {
    for (auto& plane : run.map["planes"]) {
      if (plane["id"] == TinyRun::MapId(truth)) return plane;
    }
    throw std::logic_error("no such map plane");
  }

  static TinyWorld* world_;
  static fs::path* folder_;
};
TinyWorld* EvaluateTinyWorld::world_ = nullptr;
fs::path* EvaluateTinyWorld::folder_ = nullptr;

using Keys = std::set<std::string>;

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
  for (const char* key : {"pq", "sq", "rq", "pixel_precision", "pixel_recall"}) {
    EXPECT_EQ(x[key], 1.0) << key;
  }
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
  EXPECT_NEAR(map["area_explained"].get<double>(), 1.0, kExact);
  EXPECT_EQ(m["timing_ms"]["mt"]["mean"], 10.0);
  EXPECT_EQ(m["timing_ms"]["fps"], 100.0);
  EXPECT_EQ(m["timing_ms"]["peak_rss_mb"], 128.5);
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
      if (i > 0) ++moved_decisions;
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
                  "association/mota", "association/merged_map_planes", "map/planes",
                  "map/matched", "map/merged", "map/area_explained"}));
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
  EXPECT_EQ(Moved(before, after),
            (Keys{"association/pair", "association/b_cubed", "association/decision",
                  "association/idf1", "association/hota", "association/ass_a",
                  "association/mota", "association/id_switches",
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
  EXPECT_EQ(
      Moved(before, after),
      (Keys{"trajectory/ate_se3", "trajectory/ate_origin", "trajectory/ate_complete_rmse_m",
            "trajectory/rpe_1s", "trajectory/rpe_1m", "map/normal_deg", "map/offset_mm",
            "map/vertex_mm", "map/polygon_iou", "map/area_explained"}));
  EXPECT_NEAR(after["trajectory"]["ate_origin"]["max_m"].get<double>(), std::hypot(0.02, 0.01),
              kExact);
}

TEST_F(EvaluateTinyWorld, AFramePlaneThatLooksTheWrongWayIsHalfATurnOff) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  for (auto& frame : run.frames) {
    for (auto& plane : frame["planes"]) {
      for (auto& component : plane["normal"]) component = -component.get<double>();
      plane["d"] = -plane["d"].get<double>();
    }
  }
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after), Keys{"extraction/normal_deg"});
  EXPECT_NEAR(after["extraction"]["normal_deg"]["median"].get<double>(), 180.0, 1e-6);
}

TEST_F(EvaluateTinyWorld, AMapPlaneWithTheWrongSignOfItsDistanceIsFarFromItsTruth) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  for (auto& plane : run.map["planes"]) plane["d"] = -plane["d"].get<double>();
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after), Keys{"map/offset_mm"});
  EXPECT_GT(after["map"]["offset_mm"]["median"].get<double>(), 100.0);
}

TEST_F(EvaluateTinyWorld, CornersOffByAFewMillimetresShowAsSuchAndFarOnesAsMissing) {
  TinyRun near(*world_), far(*world_);
  const nlohmann::json before = Metrics(near);
  const auto shift = [](TinyRun& run, double by_m) {
    for (auto& frame : run.frames) {
      for (auto& plane : frame["planes"]) {
        for (auto& corner : plane["vertices"]) corner[0] = corner[0].get<double>() + by_m;
      }
    }
  };
  shift(near, 0.004);
  const nlohmann::json after = Metrics(near);
  EXPECT_EQ(Moved(before, after), Keys{"vertices/error_mm"});
  EXPECT_NEAR(after["vertices"]["error_mm"]["median"].get<double>(), 4.0, kExact_mm);
  shift(far, 5.0);
  const nlohmann::json lost = Metrics(far);
  EXPECT_EQ(lost["vertices"]["precision"], 0.0);
  EXPECT_EQ(lost["vertices"]["recall"], 0.0);
  EXPECT_EQ(lost["vertices"]["planes_with_4"], 0.0);
  EXPECT_FALSE(lost["vertices"].contains("error_mm"));
}

TEST_F(EvaluateTinyWorld, ASegmentThatSwallowsABookIsUnderSegmentedAndNotMissedOnly) {
  TinyRun run(*world_);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const auto* desk = FramePlane(run, i, TinyWorld::kDeskTop);
    const auto* book = FramePlane(run, i, TinyWorld::kThinTop);
    ASSERT_TRUE(desk != nullptr && book != nullptr);
    const int from = (*book)["index"].get<int>() + 1, to = (*desk)["index"].get<int>() + 1;
    run.segmentation[i].setTo(to, run.segmentation[i] == from);
    auto& planes = run.frames[i]["planes"];
    planes.erase(planes.begin() + (from - 1));
  }
  const nlohmann::json after = Metrics(run);
  EXPECT_GT(after["extraction"]["under"].get<double>(), 0.9);
  EXPECT_LT(after["extraction"]["pixel_precision"].get<double>(), 1.0);
  EXPECT_LT(after["extraction"]["pq"].get<double>(), 1.0);
  EXPECT_EQ(after["association"]["decision"]["precision"], 1.0);
}

TEST_F(EvaluateTinyWorld, APlaneOnTheToyIsNoiseUnlessTheRunDistrustsIt) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  nlohmann::json plane = run.frames[20]["planes"][0];
  plane["index"] = 40;
  plane["map_plane"] = nullptr;
  plane["decision"] = "none";
  plane["vertices"] = nlohmann::json::array();
  run.frames[20]["planes"].push_back(plane);
  cv::Mat1b& labels = run.segmentation[20];
  labels.setTo(41, world_->frames[20].object_ids == TinyWorld::kToy);
  nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"extraction/machine", "extraction/noise", "extraction/pq", "extraction/rq",
                  "extraction/pixel_precision"}));
  run.frames[20]["planes"].back()["bad"] = "unstructured";
  EXPECT_EQ(Moved(before, Metrics(run)), Keys{});
}

TEST_F(EvaluateTinyWorld, WithoutMasksTheGeometryFindsTheSameTruthAndPixelFiguresAreAbsent) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  run.segmentation.clear();
  const nlohmann::json after = Metrics(run);
  EXPECT_EQ(Moved(before, after),
            (Keys{"extraction/truth", "extraction/machine", "extraction/correct",
                  "extraction/over", "extraction/under", "extraction/missed",
                  "extraction/noise", "extraction/pq", "extraction/sq", "extraction/rq",
                  "extraction/pixel_precision", "extraction/pixel_recall"}));
  EXPECT_FALSE(after["extraction"].contains("pq"));
  EXPECT_TRUE(after["extraction"].contains("normal_deg"));
  EXPECT_THAT(after["rules"]["truth_of_a_frame_plane"].get<std::string>(),
              HasSubstr("no segmentation images"));
}

TEST_F(EvaluateTinyWorld, ARunWithoutPosesHasNoErrorOfZero) {
  TinyRun run(*world_);
  run.trajectory.clear();
  const Evaluation evaluation = EvaluationOf(run);
  EXPECT_EQ(evaluation.tracked, 0u);
  const nlohmann::json m = nlohmann::json::parse(MetricsText(evaluation));
  EXPECT_FALSE(m["trajectory"].contains("ate_se3"));
  EXPECT_FALSE(m["trajectory"].contains("ate_origin"));
  EXPECT_FALSE(m.contains("map"));
  EXPECT_GT(m["trajectory"]["ate_complete_rmse_m"].get<double>(), 1.0);  // all frames charged
  EXPECT_THAT(MetricsTable(evaluation), HasSubstr("not defined"));
}

TEST_F(EvaluateTinyWorld, APoseForAFrameThatDoesNotExistIsRefused) {
  TinyRun run(*world_);
  run.trajectory.emplace_back(99.5, Pose{});
  try {
    EvaluationOf(run);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("trajectory.txt"));
    EXPECT_THAT(error.what(), HasSubstr("99.5"));
  }
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
