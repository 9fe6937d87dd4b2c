// The list of events and the table of frames: each fault that is planted is listed once, with its
// frame, its planes and its harm, and nothing else is.
#include "eval/report/run_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "eval/report/table.h"
#include "tests/eval/report/evaluated_world.h"

namespace eval {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

class EventsOfTinyWorld : public EvaluateTinyWorld {
 protected:
  static std::vector<RunEvent> Events(const TinyRun& run) {
    return EventsOf(EvaluationOf(run), ReadSequence(SequenceFolder()));
  }
  static std::vector<RunEvent> Of(EventKind kind, const std::vector<RunEvent>& events) {
    std::vector<RunEvent> found;
    for (const RunEvent& event : events) {
      if (event.kind == kind) found.push_back(event);
    }
    return found;
  }
  static constexpr std::size_t kFrame = 40;  // after the first second
};

TEST_F(EventsOfTinyWorld, AFaultlessRunHasNone) {
  EXPECT_TRUE(Events(TinyRun(*world_)).empty());
  EXPECT_EQ(EventsJsonLines({}), "");
}

TEST_F(EventsOfTinyWorld, ABookPutOnTheDeskIsWrongByItsHeightTimesItsPixels) {
  TinyRun run(*world_);
  nlohmann::json* plane = FramePlane(run, kFrame, TinyWorld::kThickTop);
  ASSERT_NE(plane, nullptr);
  (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
  (*plane)["by"] = "overlap";
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 1u);
  const RunEvent& event = events[0];
  EXPECT_EQ(event.kind, EventKind::kWrong);
  EXPECT_EQ(event.frame, int(kFrame));
  EXPECT_EQ(event.stamp_s, world_->frames[kFrame].stamp_s);
  EXPECT_EQ(event.truth, TinyWorld::kThickTop);
  EXPECT_EQ(event.other_truth, TinyWorld::kDeskTop);
  EXPECT_EQ(event.map_plane, TinyRun::MapId(TinyWorld::kDeskTop));
  EXPECT_EQ(event.right_map_plane, TinyRun::MapId(TinyWorld::kThickTop));
  EXPECT_EQ(event.cue, "overlap");
  EXPECT_EQ(event.pixels, (*plane)["pixels"].get<int>());
  EXPECT_NEAR(event.distance_mm.value(), 60.0, kExact_mm);  // the book is 6 cm thick
  EXPECT_NEAR(event.harm_px_mm.value(), 60.0 * double(*event.pixels), 1e3 * kExact_mm);
}

TEST_F(EventsOfTinyWorld, AnotherMapPlaneForAKnownBookIsMissedAndASplitOnceItHasThreeFrames) {
  TinyRun run(*world_);
  for (std::size_t i = kFrame; i < kFrame + 4; ++i) {
    nlohmann::json* plane = FramePlane(run, i, TinyWorld::kThinTop);
    ASSERT_NE(plane, nullptr);
    (*plane)["map_plane"] = 900;
    (*plane)["decision"] = i == kFrame ? "new" : "matched";
  }
  nlohmann::json copy = MapPlane(run, TinyWorld::kThinTop);
  copy["id"] = 900;
  run.map["planes"].push_back(copy);
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 2u);
  const std::vector<RunEvent> missed = Of(EventKind::kMissed, events);
  ASSERT_EQ(missed.size(), 1u);
  EXPECT_EQ(missed[0].map_plane, 900);
  EXPECT_EQ(missed[0].right_map_plane, TinyRun::MapId(TinyWorld::kThinTop));
  EXPECT_NEAR(missed[0].harm_px_mm.value(), 0.0,
              1e3 * kExact_mm);  // it lies in the right place
  const std::vector<RunEvent> split = Of(EventKind::kSplit, events);
  ASSERT_EQ(split.size(), 1u);
  EXPECT_EQ(split[0].truth, TinyWorld::kThinTop);
  EXPECT_EQ(split[0].frames, 4);
  EXPECT_EQ(split[0].map_plane, 900);
}

TEST_F(EventsOfTinyWorld, APlaneThatTheRunSplitOffIsListedWithWhatBothShow) {
  TinyRun run(*world_);
  nlohmann::json& top = MapPlane(run, TinyWorld::kThinTop);
  top["split_from"] = TinyRun::MapId(TinyWorld::kDeskTop);
  top["split_at"] = 1.0;
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::kSplitOff);
  EXPECT_EQ(events[0].truth, TinyWorld::kThinTop);
  EXPECT_EQ(events[0].other_truth, TinyWorld::kDeskTop);
  EXPECT_EQ(events[0].map_plane, TinyRun::MapId(TinyWorld::kThinTop));
  EXPECT_EQ(events[0].right_map_plane, TinyRun::MapId(TinyWorld::kDeskTop));
  EXPECT_EQ(events[0].harm_px_mm, std::nullopt);
}

TEST_F(EventsOfTinyWorld, AMergeSumsUpWhatItsWrongDecisionsDid) {
  TinyRun run(*world_);
  for (std::size_t i = kFrame; i < kFrame + 3; ++i) {
    nlohmann::json* plane = FramePlane(run, i, TinyWorld::kThinTop);
    (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
  }
  const std::vector<RunEvent> events = Events(run);
  const std::vector<RunEvent> wrong = Of(EventKind::kWrong, events);
  const std::vector<RunEvent> merge = Of(EventKind::kMerge, events);
  ASSERT_EQ(wrong.size(), 3u);
  ASSERT_EQ(merge.size(), 1u);
  EXPECT_EQ(events.front().kind, EventKind::kMerge);  // the most harmful first
  EXPECT_EQ(merge[0].truth, TinyWorld::kThinTop);
  EXPECT_EQ(merge[0].other_truth, TinyWorld::kDeskTop);
  EXPECT_EQ(merge[0].frames, 3);
  double harm = 0.0;
  for (const RunEvent& event : wrong) harm += *event.harm_px_mm;
  EXPECT_NEAR(merge[0].harm_px_mm.value(), harm, 1e4 * kExact_mm);
}

// Three decisions, so a merge; two of them on pieces of the book in one frame.
TEST(PlaneEvents, CountFramesNotDecisions) {
  DecisionHistory history;
  for (const auto& [frame, truth] : {std::pair{0, 1}, {1, 1}, {2, 1}, {2, 2}, {2, 2}, {3, 2}}) {
    history.decisions.push_back({{frame, truth, 7, 10}, 0.0, "", Eigen::Vector3d::Zero()});
  }
  const std::vector<RunMapPlane> map;
  const SceneTruth scene;
  const std::optional<Alignment> gauge;
  const std::vector<RunEvent> events = FindPlaneEvents(history, {}, {}, {map, scene, gauge});
  const auto merge = std::find_if(events.begin(), events.end(), [](const RunEvent& event) {
    return event.kind == EventKind::kMerge;
  });
  ASSERT_NE(merge, events.end());
  EXPECT_EQ(merge->truth, 2);
  EXPECT_EQ(merge->frames, 2);
  EXPECT_EQ(merge->pixels, 30);
}

TEST_F(EventsOfTinyWorld, ALargeSurfaceWithoutADecisionIsListedAndCountedAfterTheFirstSecond) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run);
  for (const std::size_t i : {std::size_t{5}, kFrame}) {  // the first one is too early to count
    nlohmann::json* plane = FramePlane(run, i, TinyWorld::kDeskTop);
    (*plane)["map_plane"] = nullptr;
    (*plane)["decision"] = "none";
    (*plane)["by"] = "candidate";
  }
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, EventKind::kNoDecision);
  EXPECT_EQ(events[0].frame, int(kFrame));
  EXPECT_EQ(events[0].truth, TinyWorld::kDeskTop);
  EXPECT_EQ(events[0].cue, "candidate");
  EXPECT_EQ(events[0].right_map_plane, TinyRun::MapId(TinyWorld::kDeskTop));
  EXPECT_FALSE(events[0].harm_px_mm);
  const nlohmann::json after = Metrics(run)["association"]["no_decision"];
  EXPECT_EQ(before["association"]["no_decision"]["share"], 0.0);
  EXPECT_EQ(after["events"], 1);
  EXPECT_EQ(after["share"], 1.0 / after["surfaces"].get<double>());
}

TEST_F(EventsOfTinyWorld, ABookLeftAsAmbiguousIsListedAndWithTheDeskCounted) {
  TinyRun run(*world_);
  const nlohmann::json before = Metrics(run)["association"]["decision"];
  int book_px = 0;
  for (const int truth : {TinyWorld::kDeskTop, TinyWorld::kThickTop}) {
    nlohmann::json* plane = FramePlane(run, kFrame, truth);
    ASSERT_NE(plane, nullptr);
    (*plane)["map_plane"] = nullptr;
    (*plane)["decision"] = "none";
    (*plane)["by"] = "ambiguous";
    book_px = (*plane)["pixels"];
  }
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].kind, EventKind::kNoDecision);  // the desk, which is large
  EXPECT_EQ(events[1].kind, EventKind::kAmbiguous);
  EXPECT_EQ(events[1].frame, int(kFrame));
  EXPECT_EQ(events[1].truth, TinyWorld::kThickTop);
  EXPECT_EQ(events[1].right_map_plane, TinyRun::MapId(TinyWorld::kThickTop));
  EXPECT_EQ(events[1].pixels, book_px);
  EXPECT_FALSE(events[1].harm_px_mm);  // it was put nowhere
  const nlohmann::json after = Metrics(run)["association"]["decision"];
  EXPECT_EQ(before["ambiguous"], 0);
  EXPECT_EQ(after["ambiguous"], 2);
  EXPECT_EQ(after["tp"], before["tp"].get<int>() - 2);
  EXPECT_EQ(after["recall"], 1.0);
  // Five of seven planes right, a large surface undecided, two planes ambiguous; 10 ms.
  const Evaluation evaluation = EvaluationOf(run);
  EXPECT_THAT(FramesCsv(evaluation, ReadRun(RunFolder()), ReadSequence(SequenceFolder())),
              HasSubstr(",5,0,0,0,0,1,2,10\n"));
}

TEST_F(EventsOfTinyWorld, ARunThatSaysByOfNoPlaneCannotTellWhatIsAmbiguous) {
  TinyRun run(*world_);
  for (nlohmann::json& frame : run.frames) {
    for (nlohmann::json& plane : frame["planes"]) plane.erase("by");
  }
  const Evaluation evaluation = EvaluationOf(run);
  const nlohmann::json metrics = nlohmann::json::parse(MetricsText(evaluation));
  EXPECT_TRUE(metrics["association"]["decision"].at("ambiguous").is_null());
  const auto reason =
      metrics["reasons"].at("association/decision/ambiguous").get<std::string>();
  EXPECT_THAT(reason, HasSubstr("`by`"));
  EXPECT_THAT(MetricsTable(evaluation), HasSubstr("-  (" + reason + ")"));
  EXPECT_THAT(FramesCsv(evaluation, ReadRun(RunFolder()), ReadSequence(SequenceFolder())),
              ::testing::EndsWith(",0,,10\n"));
}

TEST_F(EventsOfTinyWorld, OfSurfacesStandAmongTheOthersByTheirHarm) {
  TinyRun run(*world_);
  nlohmann::json* plane = FramePlane(run, kFrame, TinyWorld::kThinTop);
  (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
  RunEvent small, large;
  small.kind = large.kind = EventKind::kSplit;
  small.harm_px_mm = 1e-3, large.harm_px_mm = 1e12;
  const std::vector<RunEvent> events =
      EventsOf(EvaluationOf(run), ReadSequence(SequenceFolder()), {small, large});
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[0].harm_px_mm, large.harm_px_mm);
  EXPECT_EQ(events[1].kind, EventKind::kWrong);
  EXPECT_EQ(events[2].harm_px_mm, small.harm_px_mm);
}

TEST_F(EventsOfTinyWorld, TheRightMapPlaneIsTheOneThatItWasMergedInto) {
  TinyRun run(*world_);
  constexpr int kMerged = 900;
  for (nlohmann::json& plane : run.map["planes"]) {
    if (plane["id"] != TinyRun::MapId(TinyWorld::kDeskTop)) continue;
    nlohmann::json merged = plane;
    merged["id"] = kMerged;
    plane["merged_into"] = kMerged;
    run.map["planes"].push_back(merged);
    break;
  }
  nlohmann::json* plane = FramePlane(run, kFrame, TinyWorld::kDeskTop);
  (*plane)["map_plane"] = nullptr;
  (*plane)["decision"] = "none";
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].right_map_plane, kMerged);
}

TEST_F(EventsOfTinyWorld, TheRightMapPlaneOfAWrongDecisionIsThatOfTheFinalMap) {
  TinyRun run(*world_);
  constexpr int kMerged = 900;
  nlohmann::json& planes = run.map["planes"];
  for (std::size_t k = 0; k < planes.size(); ++k) {
    if (planes[k]["id"] != TinyRun::MapId(TinyWorld::kThickTop)) continue;
    nlohmann::json merged = planes[k];
    merged["id"] = kMerged;
    planes[k]["merged_into"] = kMerged;
    planes.push_back(merged);
    break;
  }
  nlohmann::json* plane = FramePlane(run, kFrame, TinyWorld::kThickTop);
  (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
  const std::vector<RunEvent> wrong = Of(EventKind::kWrong, Events(run));
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_EQ(wrong[0].map_plane, TinyRun::MapId(TinyWorld::kDeskTop));
  EXPECT_EQ(wrong[0].right_map_plane, kMerged);
}

TEST_F(EventsOfTinyWorld, ASurfaceThatNoFramePlaneShowsSaysSo) {
  TinyRun run(*world_);
  auto& planes = run.frames[kFrame]["planes"];
  const nlohmann::json* desk = FramePlane(run, kFrame, TinyWorld::kDeskTop);
  const int index = (*desk)["index"];
  planes.erase(std::find(planes.begin(), planes.end(), *desk));
  run.segmentation[kFrame].setTo(0, run.segmentation[kFrame] == index + 1);
  const std::vector<RunEvent> events = Events(run);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].cue, kNoFramePlane);
}

TEST_F(EventsOfTinyWorld, LostFramesAreOneEventForEachTimeTheWayWasLost) {
  TinyRun run(*world_);
  run.trajectory.erase(run.trajectory.begin() + 30, run.trajectory.begin() + 34);
  run.trajectory.erase(run.trajectory.begin() + 10);
  run.info["tracked"] = run.trajectory.size();
  const std::vector<RunEvent> lost = Of(EventKind::kLost, Events(run));
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0].frame, 10);
  EXPECT_EQ(lost[0].frames, 1);
  EXPECT_EQ(lost[1].frame, 30);
  EXPECT_EQ(lost[1].frames, 4);
}

TEST_F(EventsOfTinyWorld, TablesHaveALineForEachAndQuoteWhatHoldsACommaOrAQuote) {
  RunEvent event;
  event.cue = "a,\"b\"";
  event.truth = 3;
  event.harm_px_mm = 1.5;
  EXPECT_EQ(EventsCsv({event}),
            "kind,frame,time_s,frames,truth,other_truth,map_plane,right_map_plane,cue,pixels,"
            "distance_mm,harm_px_mm\nwrong,0,0,1,3,,,,\"a,\"\"b\"\"\",,,1.5\n");
  const auto json = nlohmann::json::parse(EventsJsonLines({event}));
  EXPECT_EQ(json["cue"], "a,\"b\"");
  EXPECT_TRUE(json["map_plane"].is_null());
}

TEST_F(EventsOfTinyWorld, FramesHaveALineEachWithTheirErrorsAndDecisions) {
  TinyRun run(*world_);
  nlohmann::json* plane = FramePlane(run, kFrame, TinyWorld::kThickTop);
  (*plane)["map_plane"] = TinyRun::MapId(TinyWorld::kDeskTop);
  const Evaluation evaluation = EvaluationOf(run);
  const std::string text =
      FramesCsv(evaluation, ReadRun(RunFolder()), ReadSequence(SequenceFolder()));
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 46u);
  EXPECT_THAT(lines[0], StartsWith("frame,time_s,tracked,position_error_mm"));
  const auto columns = [](const std::string& line) {
    return std::count(line.begin(), line.end(), ',');
  };
  for (const std::string& line : lines) EXPECT_EQ(columns(line), columns(lines[0])) << line;
  EXPECT_THAT(lines[kFrame + 1], StartsWith("40,"));
  // Six of seven planes right, one wrong; none missed, first, spurious, undecided or ambiguous;
  // 10 ms.
  EXPECT_THAT(lines[kFrame + 1], ::testing::EndsWith(",6,1,0,0,0,0,0,10"));
}

TEST_F(EventsOfTinyWorld, NoiseIsSpuriousInItsFirstFrameAndInThoseAfterIt) {
  TinyRun run(*world_);
  nlohmann::json on_toy = run.map["planes"][0];
  on_toy["id"] = 990;
  run.map["planes"].push_back(on_toy);
  for (const std::size_t frame : {kFrame - 1, kFrame}) {  // a plane on the toy, which has none
    nlohmann::json& planes = run.frames[frame]["planes"];
    nlohmann::json plane = planes[0];
    plane["index"] = planes.size(), plane["map_plane"] = 990;
    plane["decision"] = frame < kFrame ? "new" : "matched";
    planes.push_back(plane);
    run.segmentation[frame].setTo(static_cast<double>(planes.size()),
                                  world_->frames[frame].object_ids == TinyWorld::kToy);
  }
  const Evaluation evaluation = EvaluationOf(run);
  std::istringstream stream(
      FramesCsv(evaluation, ReadRun(RunFolder()), ReadSequence(SequenceFolder())));
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  EXPECT_THAT(lines.at(kFrame), ::testing::EndsWith(",0,0,0,1,0,0,10"));
  EXPECT_THAT(lines.at(kFrame + 1), ::testing::EndsWith(",0,0,0,1,0,0,10"));
}

TEST_F(EventsOfTinyWorld, ErrorsOfPositionAreInMillimetres) {
  TinyRun run(*world_);
  run.trajectory[kFrame].second.t.z() += 0.030;
  const Evaluation evaluation = EvaluationOf(run);
  std::istringstream stream(
      FramesCsv(evaluation, ReadRun(RunFolder()), ReadSequence(SequenceFolder())));
  std::vector<double> errors_mm;
  std::string line;
  for (std::getline(stream, line); std::getline(stream, line);) {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; column < 4; ++column) std::getline(cells, cell, ',');
    errors_mm.push_back(std::stod(cell));
  }
  ASSERT_EQ(errors_mm.size(), world_->frames.size());
  // Of one pose among 45 the alignment takes back a little, and lays that on the others.
  EXPECT_NEAR(errors_mm[kFrame], 30.0, 5.0);
  for (std::size_t i = 0; i < kFrame; ++i) EXPECT_LT(errors_mm[i], 5.0) << i;
}

TEST(FramesCsv, HasTheErrorOfThePoseNearestToTheFrame) {
  Sequence sequence;
  sequence.frames.resize(1);
  sequence.frames[0].stamp_s = 1.0;
  Evaluation evaluation;
  evaluation.trajectory.tracked_frames = {true};
  for (const auto& [stamp_s, error_m] : {std::pair{0.995, 0.5}, {1.0, 0.25}, {1.005, 0.75}}) {
    PoseError error;
    error.stamp_s = stamp_s;
    error.position_m = error_m;
    evaluation.trajectory.errors.push_back(error);
  }
  EXPECT_THAT(FramesCsv(evaluation, {}, sequence), HasSubstr("\n0,1,1,250,"));
}

}  // namespace
}  // namespace eval
