// Sequences and runs that are broken in one place each: what would make a figure wrong is refused
// with the file's name, what should be known beside the figures is a warning.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "eval/export/exportable.h"
#include "eval/report/table.h"
#include "io/input_error.h"
#include "io/read_file.h"
#include "tests/eval/report/evaluated_world.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"

namespace eval {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::TinyRun;

class EvaluateBrokenInput : public EvaluateTinyWorld {
 protected:
  using Spoil = std::function<void()>;

  EvaluateBrokenInput() {
    fs::remove_all(seq());
    fs::copy(SequenceFolder(), seq(), fs::copy_options::recursive);
    tiny_.info["sequence"] = "../BROKEN_SEQ";
  }
  static fs::path seq() { return *folder_ / "BROKEN_SEQ"; }
  static std::string Text(const fs::path& file) { return io::ReadFile(file); }
  static std::string FirstFile(const std::string& folder, const fs::path& place) {
    return StampedFiles(place / folder).Find(0.0).value().string();
  }
  static void ReplaceIn(const fs::path& file, const std::string& what, const std::string& by) {
    std::string text = Text(file);
    const auto at = text.find(what);
    ASSERT_NE(at, std::string::npos) << what;
    io::WriteFile(file, text.replace(at, what.size(), by));
  }

  Evaluation Score(const Spoil& spoil = nullptr) {
    tiny_.Write(RunFolder());
    if (spoil) spoil();
    const eval::Run run = ReadRun(RunFolder());
    return Evaluate(run, ReadSequence(SequenceOf(run)));
  }
  std::string Refusal(const Spoil& spoil = nullptr) {
    return test_support::RefusalOf([&] { Score(spoil); });
  }

  TinyRun tiny_{*world_};
};

TEST_F(EvaluateBrokenInput, AnEmptyGroundtruthIsRefused) {
  io::WriteFile(seq() / "groundtruth.txt", "# timestamp tx ty tz qx qy qz qw\n");
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("groundtruth.txt"), HasSubstr("holds no pose")));
}

TEST_F(EvaluateBrokenInput, TruthOfAnotherTimeIsRefused) {
  std::string shifted;
  for (const testing::TinyFrame& frame : world_->frames) {
    shifted += testing::TumLine(frame.stamp_s + 1000.0, frame.T_gc);
  }
  io::WriteFile(seq() / "groundtruth.txt", shifted);
  EXPECT_THAT(Refusal(), HasSubstr("groundtruth.txt: lacks a pose for the frame 0.000000"));
  fs::remove_all(seq() / "gt");  // now it is a recording, whose truth has a clock of its own
  fs::remove(seq() / "manifest.json");
  EXPECT_THAT(Refusal(), HasSubstr("groundtruth.txt: has no pose within 10 ms of any frame"));
}

TEST_F(EvaluateBrokenInput, IdImagesOfEightBitsAreRefused) {
  const std::string file = FirstFile("gt/plane_id", seq());
  cv::Mat ids = test_support::ReadImageFile(file);
  ids.convertTo(ids, CV_8U);
  test_support::WriteImageFile(file, ids);
  EXPECT_THAT(Refusal(), AllOf(HasSubstr(file), HasSubstr("expected 16-bit")));
}

TEST_F(EvaluateBrokenInput, AnIdThatTheSceneDoesNotHaveIsRefused) {
  const std::string file = FirstFile("gt/plane_id", seq());
  cv::Mat1w ids = test_support::ReadImageFile(file);
  ids(3, 4) = 777;
  test_support::WriteImageFile(file, ids);
  EXPECT_THAT(Refusal(), AllOf(HasSubstr(file), HasSubstr("plane 777")));
}

TEST_F(EvaluateBrokenInput, AnIdImageThatIsMissingIsRefused) {
  fs::remove(FirstFile("gt/plane_id", seq()));
  EXPECT_THAT(Refusal(), HasSubstr("gt/plane_id: has no image of the frame"));
}

TEST_F(EvaluateBrokenInput, ASegmentationOfSixteenBitsIsRefused) {
  const auto widen = [] {
    const std::string file = FirstFile("segmentation", RunFolder());
    cv::Mat labels = test_support::ReadImageFile(file);
    labels.convertTo(labels, CV_16U);
    test_support::WriteImageFile(file, labels);
  };
  EXPECT_THAT(Refusal(widen), AllOf(HasSubstr("segmentation"), HasSubstr("expected 8-bit")));
}

TEST_F(EvaluateBrokenInput, ALabelWithoutAPlaneIsRefused) {
  tiny_.segmentation[0](5, 6) = 200;
  EXPECT_THAT(Refusal(), HasSubstr("shows the value 200"));
}

TEST_F(EvaluateBrokenInput, EmptyFramePlanesAreRefused) {
  tiny_.segmentation.clear();
  tiny_.frames.clear();
  EXPECT_THAT(Refusal(), HasSubstr("frame_planes.jsonl: holds no frame"));
}

TEST_F(EvaluateBrokenInput, AMapPlaneThatTheMapDoesNotHaveIsRefused) {
  tiny_.frames[2]["planes"][0]["map_plane"] = 4711;
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("frame_planes.jsonl:3 /planes/0/map_plane"),
                               HasSubstr("4711, which is no plane of map.json")));
}

TEST_F(EvaluateBrokenInput, AMatchWithoutAMapPlaneIsRefused) {
  tiny_.frames[2]["planes"][0]["map_plane"] = nullptr;
  EXPECT_THAT(Refusal(), HasSubstr("is null, but the decision is matched"));
}

TEST_F(EvaluateBrokenInput, TwoRecordsOfAFrameAreRefused) {
  tiny_.trajectory[3].first = tiny_.trajectory[2].first;
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("trajectory.txt:4"), HasSubstr("a second time")));
  tiny_ = TinyRun(*world_);
  tiny_.frames[3]["timestamp"] = tiny_.frames[2]["timestamp"];
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("frame_planes.jsonl:4"), HasSubstr("a second time")));
}

TEST_F(EvaluateBrokenInput, MergesThatGoInACircleOrNowhereAreRefused) {
  auto& planes = tiny_.map["planes"];
  planes[0]["merged_into"] = planes[1]["id"];
  planes[1]["merged_into"] = planes[0]["id"];
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("map.json"), HasSubstr("back to the plane itself")));
  planes[1]["merged_into"] = 4711;
  EXPECT_THAT(Refusal(), HasSubstr("4711, which is no plane of the map"));
}

TEST_F(EvaluateBrokenInput, NumbersThatCannotBeAreRefused) {
  const auto edit = [](const char* file, const std::string& line) {
    return [=] { io::WriteFile(RunFolder() / file, line); };
  };
  EXPECT_THAT(Refusal(edit("trajectory.txt", "0 0 0 0 0 0 0 10\n")),
              AllOf(HasSubstr("trajectory.txt:1"), HasSubstr("length 10.0")));
  EXPECT_THAT(Refusal(edit("trajectory.txt", "0 0 1e200 0 0 0 0 1\n")),
              AllOf(HasSubstr("trajectory.txt:1"), HasSubstr("within 1e+07 m")));
  tiny_.map["planes"][0]["hull"][1][2] = 1e200;
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("map.json /planes/0/hull/1"), HasSubstr("at most")));
  tiny_ = TinyRun(*world_);
  tiny_.map["planes"][0]["d"] = -1e200;
  EXPECT_THAT(Refusal(), HasSubstr("map.json /planes/0/d"));
}

TEST_F(EvaluateBrokenInput, ARunOfAnotherRecordingIsRefused) {
  fs::remove_all(seq() / "gt");
  fs::remove(seq() / "manifest.json");
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) stamp_s += 500.0;
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("trajectory.txt:1"), HasSubstr("belongs to no frame")));
}

TEST_F(EvaluateBrokenInput, LinesOfPlanesAtTimesOfNoFrameAreRefused) {
  tiny_.segmentation.clear();
  for (auto& frame : tiny_.frames) frame["timestamp"] = frame["timestamp"].get<double>() + 0.01;
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("frame_planes.jsonl:1"),
                    HasSubstr("the line of planes at 0.010000 s belongs to no frame")));
  // One frame of many is refused too: its planes would count as not found.
  tiny_ = TinyRun(*world_);
  tiny_.segmentation.clear();
  tiny_.frames[7]["timestamp"] = tiny_.frames[7]["timestamp"].get<double>() + 0.01;
  EXPECT_THAT(Refusal(), HasSubstr("frame_planes.jsonl:8"));
}

TEST_F(EvaluateBrokenInput, ALineOfPlanesIsMissingWithoutARefusal) {
  tiny_.segmentation.clear();
  tiny_.frames.erase(tiny_.frames.begin() + 7);
  EXPECT_EQ(Refusal(), "");
}

TEST_F(EvaluateBrokenInput, AFaultlessRunHasNoWarningAndNoReason) {
  const Evaluation evaluation = Score();
  EXPECT_THAT(evaluation.run_warnings, IsEmpty());
  EXPECT_THAT(evaluation.sequence_warnings, IsEmpty());
  const nlohmann::json m = nlohmann::json::parse(MetricsText(evaluation));
  EXPECT_FALSE(m.contains("reasons"));
  EXPECT_FALSE(m.contains("interrupted"));
}

TEST_F(EvaluateBrokenInput, WhatCanBeLivedWithIsAWarningInMetricsToo) {
  ReplaceIn(seq() / "manifest.json", "\"complete\": true", "\"complete\": false");
  const nlohmann::json m = nlohmann::json::parse(MetricsText(Score()));
  EXPECT_THAT(m.at("warnings"),
              ElementsAre(HasSubstr("SEQ/manifest.json /complete: is false: the sequence was "
                                    "not finished")));
}

TEST_F(EvaluateBrokenInput, AnUnfinishedSequenceIsNotExported) {
  ReplaceIn(seq() / "manifest.json", "\"complete\": true", "\"complete\": false");
  EXPECT_THAT([] { ReadExportable(seq(), {}); },
              ::testing::ThrowsMessage<io::InputError>(HasSubstr("complete is false")));
}

TEST_F(EvaluateBrokenInput, AnInterruptedRunSaysSoBesideItsFigures) {
  tiny_.trajectory.resize(10);
  tiny_.frames.resize(10);
  tiny_.segmentation.resize(10);
  tiny_.info["frames"] = 10;
  tiny_.info["tracked"] = 10;
  tiny_.info["interrupted"] = true;
  tiny_.info["sequence_frames"] = 45;
  const nlohmann::json m = nlohmann::json::parse(MetricsText(Score()));
  EXPECT_EQ(m.at("interrupted"), true);
  EXPECT_EQ(m["trajectory"]["frames"], 45);
  EXPECT_THAT(m.at("warnings"),
              ElementsAre(HasSubstr("the run was interrupted after 10 of 45 frames")));
}

TEST_F(EvaluateBrokenInput, FramesThatTheRunWasNotGivenAreNamed) {
  tiny_.trajectory.resize(40);
  tiny_.frames.resize(40);
  tiny_.segmentation.resize(40);
  tiny_.info["frames"] = 40;
  tiny_.info["tracked"] = 40;
  const nlohmann::json m = nlohmann::json::parse(MetricsText(Score()));
  EXPECT_THAT(m.at("warnings"),
              ElementsAre(HasSubstr("was given 40 frames, the sequence has 45")));
}

TEST_F(EvaluateBrokenInput, ARunThatFoundNoPlaneHasNoShareOfZero) {
  for (auto& frame : tiny_.frames) frame["planes"] = nlohmann::json::array();
  for (cv::Mat1b& labels : tiny_.segmentation) labels.setTo(0);
  tiny_.map["planes"] = nlohmann::json::array();
  const Evaluation evaluation = Score();
  const nlohmann::json m = nlohmann::json::parse(MetricsText(evaluation));
  for (const char* figure :
       {"/association/pair/precision", "/association/pair/recall",
        "/association/decision/precision", "/association/decision/recall",
        "/association/decision/f1", "/association/b_cubed/f1", "/extraction/sq",
        "/extraction/pixel_precision", "/extraction/normal_deg", "/vertices/precision",
        "/map/normal_deg"}) {
    EXPECT_TRUE(m.at(nlohmann::json::json_pointer(figure)).is_null()) << figure;
    EXPECT_FALSE(m["reasons"].at(figure + 1).get<std::string>().empty()) << figure;
  }
  // There were planes to find: that none was found is a zero.
  EXPECT_EQ(m["extraction"]["pq"], 0.0);
  EXPECT_EQ(m["extraction"]["pixel_recall"], 0.0);
  EXPECT_EQ(m["association"]["idf1"], 0.0);
  EXPECT_EQ(m["association"]["mota"], 0.0);
  EXPECT_THAT(MetricsTable(evaluation), HasSubstr("decision precision         - (0 right"));
}

TEST_F(EvaluateBrokenInput, AnUndefinedTrajectoryErrorSaysWhy) {
  const auto reason = [&] { return Score().trajectory.no_ate_se3; };
  tiny_.trajectory.resize(2);
  EXPECT_THAT(reason(), HasSubstr("only 2 matched positions, 3 are needed"));
  tiny_ = TinyRun(*world_);
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) T_wc.t.setConstant(1.0);
  EXPECT_THAT(reason(), HasSubstr("stand still"));
  for (auto& [stamp_s, T_wc] : tiny_.trajectory) T_wc.t = stamp_s * Eigen::Vector3d(1, 2, 0);
  EXPECT_THAT(reason(), HasSubstr("lie on a line"));
  tiny_ = TinyRun(*world_);
  fs::remove(SequenceFolder() / "../BROKEN_SEQ/groundtruth.txt");
  tiny_.info["sequence"] = "../BROKEN_SEQ";
  EXPECT_THAT(reason(), HasSubstr("no groundtruth.txt"));
}

}  // namespace
}  // namespace eval
