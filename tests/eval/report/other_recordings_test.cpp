// Sequences of other programs: what they have is scored, and what they lack costs no other figure.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "eval/report/table.h"
#include "tests/eval/report/evaluated_world.h"

namespace eval {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class EvaluateOtherRecordings : public EvaluateTinyWorld {
 protected:
  EvaluateOtherRecordings() {
    fs::remove_all(seq());
    fs::copy(SequenceFolder(), seq(), fs::copy_options::recursive);
    tiny_.info["sequence"] = "../OTHER_SEQ";
  }
  static fs::path seq() { return *folder_ / "OTHER_SEQ"; }

  TinyRun tiny_{*world_};
};

TEST_F(EvaluateOtherRecordings, PosesWithAClockOfTheirOwnAreMatchedWhateverTheManifestSays) {
  fs::remove_all(seq() / "gt");
  io::WriteFile(seq() / "manifest.json",
                R"({"format": "pas-sequence/1", "generator": "a recorder", "complete": true})");
  std::string later;
  for (const testing::TinyFrame& frame : world_->frames) {
    later += testing::TumLine(frame.stamp_s + 0.004, frame.T_gc);
  }
  io::WriteFile(seq() / "groundtruth.txt", later);
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) stamp_s += 0.002;
  for (auto& frame : tiny_.frames) frame["timestamp"] = frame["timestamp"].get<double>() + 2e-3;
  const TrajectoryScore score = EvaluationOf(tiny_).trajectory;
  EXPECT_EQ(score.tracked, world_->frames.size());
  ASSERT_TRUE(score.ate_se3.has_value()) << score.no_ate_se3;
  EXPECT_EQ(score.ate_se3->count, world_->frames.size());
  EXPECT_NEAR(score.ate_se3->rmse, 0.0, kExact);
  EXPECT_TRUE(score.ate_complete_rmse_m.has_value()) << score.no_ate_complete;
}

TEST_F(EvaluateOtherRecordings, AWrongUnitOfDepthAndALeftHandedTruthAreNamed) {
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) T_wc.t *= 5.0;
  const nlohmann::json scaled = nlohmann::json::parse(MetricsText(EvaluationOf(tiny_)));
  EXPECT_THAT(scaled["warnings"].dump(),
              AllOf(HasSubstr("m when it is times 0.2; is depth_factor of the camera right (5 "
                              "times as large would fit)?"),
                    HasSubstr("RUN/trajectory.txt: lies ")));
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) {
    T_wc.t /= 5.0;
    T_wc.t.y() = -T_wc.t.y();
  }
  const nlohmann::json mirrored = nlohmann::json::parse(MetricsText(EvaluationOf(tiny_)));
  EXPECT_THAT(mirrored["warnings"].dump(),
              HasSubstr("m when it is mirrored; is the truth of a left-handed world"));
}

TEST_F(EvaluateOtherRecordings, ASceneWithoutWhatFramesShowCostsTheFiguresOfPlanesAlone) {
  const nlohmann::json whole = nlohmann::json::parse(MetricsText(EvaluationOf(tiny_)));
  fs::remove_all(seq() / "gt/plane_id");
  fs::remove(seq() / "gt/frames.jsonl");
  const Evaluation evaluation = EvaluationOf(tiny_);
  const nlohmann::json m = nlohmann::json::parse(MetricsText(evaluation));
  EXPECT_EQ(m["trajectory"], whole["trajectory"]);
  EXPECT_EQ(m["timing_ms"], whole["timing_ms"]);
  for (const char* group : {"extraction", "vertices", "association", "map"}) {
    EXPECT_TRUE(m.at(group).is_null()) << group;
    EXPECT_THAT(m["reasons"].at(group).get<std::string>(), HasSubstr("neither gt/plane_id/"));
  }
  EXPECT_THAT(m["warnings"], ::testing::ElementsAre(HasSubstr("SEQ/gt: has neither")));
  EXPECT_THAT(MetricsTable(evaluation), HasSubstr("-  (the sequence has neither"));
}

}  // namespace
}  // namespace eval
