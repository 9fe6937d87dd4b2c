#include "slam/detect/detections.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "io/input_error.h"
#include "tests/support/temporary_folder.h"

namespace slam {
namespace {

using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;

/// A folder of this test alone, with a detections.jsonl.
class Detections : public ::testing::Test {
 protected:
  std::unique_ptr<Detector> Replay(const std::string& text) {
    std::ofstream(folder_ / "detections.jsonl") << text;
    return MakeDetector("replay", folder_, Camera{}, CocoClassTable());
  }
  void ExpectError(const std::string& text, const std::string& regex) {
    EXPECT_THAT([&] { Replay(text); }, ThrowsMessage<io::InputError>(ContainsRegex(regex)))
        << text;
  }
  test_support::TemporaryFolder temporary_;
  const std::filesystem::path folder_ = temporary_.path();
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
  // Stamps of fewer digits, rounded up and down.
  EXPECT_EQ(detector->Detect(1.50004, {}).size(), 1u);
  EXPECT_EQ(detector->Detect(1.49996, {}).size(), 1u);
  EXPECT_TRUE(detector->Detect(1.55, {}).empty());
  EXPECT_TRUE(detector->Detect(9.0, {}).empty());
}

TEST_F(Detections, ClipsBoxesToTheImageAndLeavesOutThoseOutside) {
  std::ofstream(folder_ / "detections.jsonl")
      << R"({"timestamp": 0, "detections": [{"class": "tv", "score": 1, "box": [-9, 470, 50, 600]},
 {"class": "tv", "score": 1, "box": [700, 0, 800, 50]}]})";
  // One record a line: the text above is two.
  EXPECT_THROW(ReplayDetector(folder_ / "detections.jsonl", Camera{}, {}), io::InputError);
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
  ExpectError(good + "{\"timestamp\": 2, \"detections\": [",
              "detections.jsonl:2: not valid JSON");
  ExpectError(good + "[]", "jsonl:2: expected an object with the key \"timestamp\"");
  ExpectError(good + "{\"detections\": []}", "jsonl:2: the key \"timestamp\" is missing");
  ExpectError(good + "{\"timestamp\": \"2\", \"detections\": []}",
              "jsonl:2: timestamp: expected a number .*found \"2\"");
  ExpectError(good + good, "jsonl:2: timestamp: expected more than in the line before");
  ExpectError(good + "{\"timestamp\": 1e18, \"detections\": []}",
              "jsonl:2: timestamp: expected a number in .0, 100000000000.");
  ExpectError("{\"timestamp\": 1, \"detections\": {}}",
              "jsonl:1: detections: expected an array");
  const auto with = [](const std::string& detection) {
    return "{\"timestamp\": 1, \"detections\": [" + detection + "]}";
  };
  ExpectError(with("7"), "detections.0.: expected an object");
  ExpectError(with(R"({"score": 1, "box": [0, 0, 1, 1]})"),
              "the key \"detections.0..class\" is missing");
  ExpectError(with(R"({"class": "", "score": 1, "box": [0, 0, 1, 1]})"),
              "detections.0..class: expected a text of 1 to 100 bytes");
  ExpectError(with(R"({"class": "a", "score": 1.5, "box": [0, 0, 1, 1]})"),
              "detections.0..score: expected a number in .0, 1., found 1.5");
  ExpectError(with(R"({"class": "a", "score": NaN, "box": [0, 0, 1, 1]})"), "not valid JSON");
  ExpectError(with(R"({"class": "a", "score": 1, "box": [0, 0, 1]})"),
              "detections.0..box: expected .x0, y0, x1, y1. in pixels");
  ExpectError(with(R"({"class": "a", "score": 1, "box": [9, 0, 1, 1]})"),
              "detections.0..box: expected .*x0 <= x1 .*found .9,0,1,1.");
  ExpectError(std::string(100000, '['), "jsonl:1: nested deeper");
}

TEST_F(Detections, WarnsOfLinesWithoutFrameAndOfFramesWithoutLine) {
  const auto detector = Replay(
      "{\"timestamp\": 1.0, \"detections\": []}\n{\"timestamp\": 1.1, \"detections\": []}\n"
      "{\"timestamp\": 1.2, \"detections\": []}\n");
  EXPECT_THAT(detector->WarningsFor({1.0, 1.1, 1.2001}), IsEmpty());
  EXPECT_THAT(detector->WarningsFor({1.0}),
              ElementsAre(ContainsRegex("2 of 3 lines .* time of no frame .*timestamp 1.1$")));
  EXPECT_THAT(detector->WarningsFor({1.0, 1.1, 1.2, 1.3}),
              ElementsAre(ContainsRegex("1 of 4 frames have no line in detections.jsonl")));
  EXPECT_THAT(
      [&] {
        (void)detector->WarningsFor({5.0, 5.1});
      },
      ThrowsMessage<io::InputError>(ContainsRegex(
          "detections.jsonl: none of its lines has the time of a frame; .*--detector")));
  EXPECT_THAT(NoDetector().WarningsFor({1.0}), IsEmpty());
}

TEST_F(Detections, SaysHowToRunWithoutAFile) {
  EXPECT_THAT([&] { MakeDetector("replay", folder_, Camera{}, {}); },
              ThrowsMessage<io::InputError>(
                  ContainsRegex("detections.jsonl: no such file.*--detector none")));
  EXPECT_THAT(
      [&] { MakeDetector("yolo", folder_, Camera{}, {}); },
      ThrowsMessage<io::InputError>(ContainsRegex("expected replay, yolox:FILE.onnx or none")));
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
