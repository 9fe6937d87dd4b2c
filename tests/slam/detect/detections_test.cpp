#include "slam/detect/detections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "slam/base/require.h"

namespace slam {
namespace {

using ::testing::ContainsRegex;
using ::testing::ThrowsMessage;

/// A folder of this test alone, with a detections.jsonl.
class Detections : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              (std::string("pas_detections_") + info->name() + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::unique_ptr<Detector> Replay(const std::string& text) {
    std::ofstream(folder_ / "detections.jsonl") << text;
    return MakeDetector("replay", folder_, Camera{}, CocoClassTable());
  }
  void ExpectError(const std::string& text, const std::string& regex) {
    EXPECT_THAT([&] { Replay(text); }, ThrowsMessage<InputError>(ContainsRegex(regex))) << text;
  }
  std::filesystem::path folder_;
};

TEST_F(Detections, ReplaysTheBoxesOfTheFrameWithTheSameTimestamp) {
  const auto detector = Replay(
      R"({"timestamp": 1.5, "detections": [{"class": "book", "score": 0.91, "box": [1, 2, 30, 40]}]}
{"timestamp": 1.6, "detections": [{"class": "teddy bear", "score": 1, "box": [5, 6, 7, 8], "mood": "good"}]}
)");
  const auto at = detector->Detect(1.5, {});
  ASSERT_EQ(at.size(), 1u);
  EXPECT_EQ(at[0].class_name, "book");
  EXPECT_EQ(at[0].kind, ClassKind::kRegular);
  EXPECT_EQ(at[0].score, 0.91);
  EXPECT_EQ(at[0].box_px.max, Eigen::Vector2d(30, 40));
  EXPECT_EQ(detector->Detect(1.60004, {}).at(0).kind, ClassKind::kUnstructured);
  EXPECT_TRUE(detector->Detect(1.55, {}).empty());
  EXPECT_TRUE(detector->Detect(9.0, {}).empty());
}

TEST_F(Detections, ClipsBoxesToTheImageAndLeavesOutThoseOutside) {
  std::ofstream(folder_ / "detections.jsonl")
      << R"({"timestamp": 0, "detections": [{"class": "tv", "score": 1, "box": [-9, 470, 50, 600]},
 {"class": "tv", "score": 1, "box": [700, 0, 800, 50]}]})";
  // One record a line: the text above is two.
  EXPECT_THROW(ReplayDetector(folder_ / "detections.jsonl", Camera{}, {}), InputError);
  std::ofstream(folder_ / "detections.jsonl")
      << R"({"timestamp": 0, "detections": [{"class": "tv", "score": 1, "box": [-9, 470, 50, 600]},)"
      << R"( {"class": "tv", "score": 1, "box": [700, 0, 800, 50]}]})";
  ReplayDetector detector(folder_ / "detections.jsonl", Camera{}, {});
  const auto boxes = detector.Detect(0, {});
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].box_px.min, Eigen::Vector2d(0, 470));
  EXPECT_EQ(boxes[0].box_px.max, Eigen::Vector2d(50, 479));
}

TEST_F(Detections, NamesFileLineAndKeyOfWhatIsWrong) {
  const std::string good = "{\"timestamp\": 1, \"detections\": []}\n";
  ExpectError(good + "{\"timestamp\": 2, \"detections\": [", "detections.jsonl:2: not JSON");
  ExpectError(good + "[]", "jsonl:2: the record is not an object");
  ExpectError(good + "{\"detections\": []}", "jsonl:2: the record has no key \"timestamp\"");
  ExpectError(good + "{\"timestamp\": \"2\", \"detections\": []}",
              "jsonl:2: \"timestamp\" is \"2\"");
  ExpectError(good + good, "jsonl:2: \"timestamp\" does not increase");
  ExpectError(good + "{\"timestamp\": 1e18, \"detections\": []}",
              "jsonl:2: .*expected seconds");
  ExpectError("{\"timestamp\": 1, \"detections\": {}}",
              "jsonl:1: \"detections\" is not a list");
  const auto with = [](const std::string& detection) {
    return "{\"timestamp\": 1, \"detections\": [" + detection + "]}";
  };
  ExpectError(with("7"), "detection 0 is not an object");
  ExpectError(with(R"({"score": 1, "box": [0, 0, 1, 1]})"), "detection 0 has no key \"class\"");
  ExpectError(with(R"({"class": "", "score": 1, "box": [0, 0, 1, 1]})"),
              "\"class\" of detection 0");
  ExpectError(with(R"({"class": "a", "score": 1.5, "box": [0, 0, 1, 1]})"),
              "\"score\" of detection 0 is 1.5; expected a number in .0, 1.");
  ExpectError(with(R"({"class": "a", "score": NaN, "box": [0, 0, 1, 1]})"), "not JSON");
  ExpectError(with(R"({"class": "a", "score": 1, "box": [0, 0, 1]})"),
              "\"box\" of detection 0");
  ExpectError(with(R"({"class": "a", "score": 1, "box": [9, 0, 1, 1]})"), "turned over");
  ExpectError(std::string(100000, '['), "jsonl:1: not JSON");
}

TEST_F(Detections, SaysHowToRunWithoutAFile) {
  EXPECT_THAT([&] { MakeDetector("replay", folder_, Camera{}, {}); },
              ThrowsMessage<InputError>(
                  ContainsRegex("detections.jsonl: no such file.*--detector none")));
  EXPECT_THAT(
      [&] { MakeDetector("yolo", folder_, Camera{}, {}); },
      ThrowsMessage<InputError>(ContainsRegex("expected replay, yolox:FILE.onnx or none")));
  EXPECT_TRUE(MakeDetector("none", folder_, Camera{}, {})->Detect(1.0, {}).empty());
}

TEST(ClassTable, PutsEachOfCocosClassesInOneListOnly) {
  const ClassTable table = CocoClassTable();
  std::vector<std::string> all;
  for (const auto* list : {&table.regular, &table.unstructured, &table.other})
    all.insert(all.end(), list->begin(), list->end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(std::adjacent_find(all.begin(), all.end()), all.end());
  EXPECT_EQ(table.KindOf("book"), ClassKind::kRegular);
  EXPECT_EQ(table.KindOf("box"), ClassKind::kRegular);
  EXPECT_EQ(table.KindOf("person"), ClassKind::kUnstructured);
  EXPECT_EQ(table.KindOf("cup"), ClassKind::kOther);
  EXPECT_EQ(table.KindOf("something new"), ClassKind::kOther);
}

}  // namespace
}  // namespace slam
