#include "eval/surfaces/score_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <tuple>

#include "eval/surfaces/report_surfaces.h"
#include "tests/eval/surfaces/boards.h"
#include "tests/support/image_files.h"
#include "tests/support/refusal.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using testing::BoardWorld;

/// A run on the boards' recording: every frame has the same segmentation.
class SurfaceScoring : public ::testing::Test {
 protected:
  void SetUp() override {
    BoardWorld world;
    world.boards = {{{0, 0, 2}, {-2, 0, 0}, {0, 2, 0}}};
    sequence_ = world.Write(folder_ / "SEQ");
    run_.folder = folder_ / "RUN";
    std::filesystem::create_directories(run_.folder / "segmentation");
    for (const SequenceFrame& frame : sequence_.frames) {
      RunFrame planes;
      planes.stamp_s = frame.stamp_s;
      planes.planes.resize(3);
      for (int i = 0; i < 3; ++i) planes.planes[std::size_t(i)].index = i;
      run_.frames.push_back(planes);
    }
  }

  /// The image in four quarters, from left to right.
  static cv::Mat1w Quarters(int a, int b, int c, int d) {
    cv::Mat1w labels(BoardWorld::kHeight, BoardWorld::kWidth);
    for (int u = 0; u < labels.cols; ++u) {
      const std::array<int, 4> values{a, b, c, d};
      labels.col(u).setTo(values[std::size_t(4 * u / labels.cols)]);
    }
    return labels;
  }
  void Segment(const cv::Mat1w& labels) {
    for (const SequenceFrame& frame : sequence_.frames) {
      const std::string name = io::NumberText(frame.stamp_s) + ".png";
      cv::Mat1b bytes;
      labels.convertTo(bytes, CV_8U);
      test_support::WriteImageFile(run_.folder / "segmentation" / name, bytes);
    }
    run_.segmentation_files = StampedFiles(run_.folder / "segmentation");
  }
  void SetLandmark(std::size_t segment, std::optional<int> landmark) {
    for (RunFrame& frame : run_.frames) frame.planes[segment].map_plane = landmark;
  }
  SurfaceScore Score(const cv::Mat1w& surfaces) const {
    const DepthViews views(sequence_, *sequence_.camera, std::nullopt);
    return ScoreSurfaces(run_, views, [&](const DepthView&) { return surfaces; });
  }

  test_support::TemporaryFolder folder_;
  Sequence sequence_;
  eval::Run run_;
};

TEST_F(SurfaceScoring, CountsSegmentsOfASurface) {
  // A surface of three quarters; a segment of two of them, one of the third and of no surface.
  Segment(Quarters(1, 1, 2, 2));
  const SurfaceScore score = Score(Quarters(7, 7, 7, 0));
  EXPECT_NEAR(score.total.whole, 2.0 / 3, 1e-9);
  EXPECT_NEAR(score.total.covered, 1.0, 1e-9);
  EXPECT_NEAR(score.total.purity, 1.0, 1e-9) << "pixels on no surface do not count";
  EXPECT_EQ(score.surfaces.at(7).segments_per_frame, 2.0);
  EXPECT_EQ(score.total.segments_per_frame, 2.0);
  EXPECT_EQ(score.surfaces.at(7).no_decision, 1.0);
  EXPECT_EQ(score.frames, BoardWorld::kFrames);
}

TEST_F(SurfaceScoring, CallsASegmentOverTwoSurfacesImpure) {
  Segment(Quarters(1, 1, 1, 0));
  const SurfaceScore score = Score(Quarters(7, 7, 8, 8));
  EXPECT_NEAR(score.total.purity, 2.0 / 3, 1e-9);
  EXPECT_NEAR(score.total.covered, 3.0 / 4, 1e-9);
  EXPECT_NEAR(score.surfaces.at(8).whole, 0.5, 1e-9);
  EXPECT_EQ(score.surfaces.at(8).segments_per_frame, 0.0);
}

TEST_F(SurfaceScoring, TellsALargeSurfaceThatHasALandmarkAndGetsNoDecision) {
  const cv::Mat1w surfaces = Quarters(7, 7, 0, 0), segments = Quarters(1, 1, 2, 2);
  const std::map<int, int> landmark = {{1, 10}};
  SurfaceScorer scorer;
  EXPECT_TRUE(scorer.Add(0, surfaces, segments, {}, true).empty()) << "it has no landmark yet";
  EXPECT_TRUE(scorer.Add(1, surfaces, segments, landmark, true).empty());
  EXPECT_TRUE(scorer.Add(2, surfaces, segments, {}, false).empty()) << "too early";
  const std::vector<UndecidedSegment> undecided = scorer.Add(3, surfaces, segments, {}, true);
  ASSERT_EQ(undecided.size(), 1u);
  EXPECT_EQ(undecided[0].surface, 7);
  EXPECT_EQ(undecided[0].segment, 1);
  EXPECT_EQ(undecided[0].pixels, int(surfaces.total() / 2));
  EXPECT_TRUE(scorer.Add(4, surfaces, segments, landmark, true).empty());
  EXPECT_EQ(scorer.Score().known_surfaces, 2);
}

TEST_F(SurfaceScoring, AsksForNoDecisionInTheFirstSecond) {
  Segment(Quarters(1, 1, 2, 2));
  SetLandmark(0, 10);
  run_.map.resize(1);
  run_.map[0].id = 10;
  run_.frames.back().planes[0].map_plane.reset();
  const SurfaceScore score = Score(Quarters(7, 7, 0, 0));
  EXPECT_EQ(score.known_surfaces, 0);
  EXPECT_TRUE(score.events.empty());
  EXPECT_GT(score.total.no_decision, 0.0);
}

// Frames are numbered as in the sequence, also where some have no true pose.
TEST_F(SurfaceScoring, NumbersEventsByFramesOfTheSequence) {
  Segment(Quarters(1, 1, 2, 2));
  SetLandmark(0, 10);
  run_.map.resize(1);
  run_.map[0].id = 10;
  ASSERT_GT(sequence_.frames.size(), 4u);
  run_.frames.back().planes[0].map_plane.reset();
  run_.frames.back().planes[0].by = "chi2";
  run_.frames.back().planes[1].by = "margin";
  // The first two frames lose their poses; the recording is two seconds long.
  const double first_s = sequence_.frames.front().stamp_s;
  const double stretch = 2 / (sequence_.frames.back().stamp_s - first_s);
  const auto later = [&](double& stamp_s) {
    stamp_s = first_s + stretch * (stamp_s - first_s);
  };
  for (SequenceFrame& frame : sequence_.frames)
    later(frame.stamp_s), later(frame.depth_stamp_s);
  for (RunFrame& frame : run_.frames) later(frame.stamp_s);
  for (StampedPose& pose : *sequence_.groundtruth) later(pose.stamp_s);
  Segment(Quarters(1, 1, 2, 2));
  const double third_s = sequence_.frames[2].depth_stamp_s;
  std::erase_if(*sequence_.groundtruth,
                [&](const StampedPose& pose) { return pose.stamp_s < third_s - 1e-6; });
  const SurfaceScore score = Score(Quarters(7, 7, 0, 0));
  ASSERT_EQ(score.frames, static_cast<int>(sequence_.frames.size()) - 2);
  ASSERT_EQ(score.events.size(), 1u);
  EXPECT_EQ(score.events[0].stamp_s, sequence_.frames.back().stamp_s);
  EXPECT_EQ(score.events[0].frame, static_cast<int>(sequence_.frames.size()) - 1);
  EXPECT_EQ(score.events[0].cue, "chi2");
}

TEST_F(SurfaceScoring, CountsLandmarksFromTwoPercentOfASurfaceOn) {
  const cv::Mat1w surface(100, 100, std::uint16_t(7));
  for (const auto& [pixels, landmarks] : {std::pair(190, 1), {210, 2}}) {
    cv::Mat1w segments(100, 100, std::uint16_t(1));
    for (int i = 0; i < pixels; ++i) segments(i / 100, i % 100) = 2;
    SurfaceScorer scorer;
    scorer.Add(0, surface, segments, {{1, 10}, {2, 11}});
    EXPECT_EQ(scorer.Score().surfaces.at(7).landmarks, landmarks) << pixels;
    EXPECT_EQ(scorer.Score().total.landmarks, landmarks) << pixels;
  }
}

TEST_F(SurfaceScoring, FollowsMergesOfLandmarks) {
  Segment(Quarters(1, 2, 3, 0));
  SetLandmark(0, 10);
  SetLandmark(1, 11);
  SetLandmark(2, 12);
  // Without a map, as another system may leave it out, the ids are final.
  EXPECT_NEAR(Score(Quarters(7, 7, 7, 7)).total.coverage, 0.75, 1e-9);
  EXPECT_EQ(Score(Quarters(7, 7, 7, 7)).total.landmarks, 3.0);

  run_.has_map = true;
  run_.map.resize(3);
  for (int i = 0; i < 3; ++i) run_.map[std::size_t(i)].id = 10 + i;
  const SurfaceScore apart = Score(Quarters(7, 7, 7, 7));
  EXPECT_NEAR(apart.total.coverage, 0.75, 1e-9);
  EXPECT_NEAR(apart.total.identity, 1.0 / 3, 1e-9);
  EXPECT_EQ(apart.total.landmarks, 3.0);
  EXPECT_EQ(apart.total.no_decision, 0.0);

  run_.map[1].merged_into = 10;
  const SurfaceScore merged = Score(Quarters(7, 7, 7, 7));
  EXPECT_NEAR(merged.total.identity, 2.0 / 3, 1e-9);
  EXPECT_EQ(merged.total.landmarks, 2.0);

  run_.map[0].merged_into = 12;  // and with it what it had taken in
  const SurfaceScore in_turn = Score(Quarters(7, 7, 7, 7));
  EXPECT_NEAR(in_turn.total.coverage, 0.75, 1e-9);
  EXPECT_NEAR(in_turn.total.identity, 1.0, 1e-9);
  EXPECT_EQ(in_turn.total.landmarks, 1.0);

  run_.map[0].merged_into.reset();
  run_.map.pop_back();  // a candidate that never became a landmark
  EXPECT_NEAR(Score(Quarters(7, 7, 7, 7)).total.coverage, 0.5, 1e-9);
}

TEST_F(SurfaceScoring, WritesNullWithAReasonForAShareOfNothing) {
  Segment(Quarters(0, 0, 0, 1));
  nlohmann::ordered_json metrics;
  AddSurfaces(Score(Quarters(7, 0, 0, 0)), "surfaces.yaml", metrics);
  const auto& figures = metrics["surfaces"]["each"][0];
  EXPECT_EQ(figures["whole"], 0.0);
  EXPECT_EQ(figures["coverage"], 0.0);
  for (const char* key : {"purity", "identity"}) {
    EXPECT_TRUE(figures[key].is_null()) << key;
    EXPECT_TRUE(metrics["reasons"].contains(std::string("surfaces/each/0/") + key)) << key;
    EXPECT_TRUE(metrics["surfaces"][key].is_null()) << key;
  }
  EXPECT_TRUE(metrics["surfaces"]["no_decision_in_map"]["share"].is_null());
  AddSurfaces(Score(Quarters(0, 0, 0, 0)), "surfaces.yaml", metrics);
  EXPECT_TRUE(metrics["surfaces"]["whole"].is_null());
}

TEST(SurfaceReport, TellsEachFigureUnderItsOwnName) {
  SurfaceFigures f{0.11, 0.12, 0.13, 1.4, 0.15, 0.16, 1.7, 0.18, 19, 20, 21, 22, 23};
  SurfaceScore score;
  score.surfaces[5] = f;
  f.whole = 0.31, f.coverage = 0.32;
  score.total = f;
  nlohmann::ordered_json metrics{{"reasons", nlohmann::ordered_json::object()}};
  AddSurfaces(score, "a file", metrics);
  for (const auto& [json, whole, coverage] :
       {std::tuple(metrics["surfaces"], 0.31, 0.32),
        std::tuple(metrics["surfaces"]["each"][0], 0.11, 0.15)}) {
    EXPECT_EQ(json["whole"], whole);
    EXPECT_EQ(json["covered"], 0.12);
    EXPECT_EQ(json["purity"], 0.13);
    EXPECT_EQ(json["segments_per_frame"], 1.4);
    EXPECT_EQ(json["coverage"], coverage);
    EXPECT_EQ(json["identity"], 0.16);
    EXPECT_EQ(json["landmarks"], 1.7);
    EXPECT_EQ(json["no_decision"], 0.18);
    EXPECT_EQ(json["frames"], 19);
    EXPECT_EQ(json["pixels"], 20);
  }
  EXPECT_EQ(metrics["surfaces"]["each"][0]["id"], 5);
}

TEST_F(SurfaceScoring, RefusesARunWithoutSegmentation) {
  EXPECT_THAT(test_support::RefusalOf([&] { Score(Quarters(7, 7, 7, 7)); }),
              ::testing::HasSubstr("--save-segmentation"));
}

// Another program may write the candidate that it did not take.
TEST_F(SurfaceScoring, CountsNoLandmarkOfAPlaneThatWasNotDecided) {
  Segment(Quarters(1, 1, 1, 1));
  SetLandmark(0, 10);
  EXPECT_EQ(Score(Quarters(7, 7, 7, 7)).total.coverage, 1.0);
  for (RunFrame& frame : run_.frames) frame.planes[0].decision = "none";
  const SurfaceScore score = Score(Quarters(7, 7, 7, 7));
  EXPECT_EQ(score.total.coverage, 0.0);
  EXPECT_EQ(score.total.landmarks, 0.0);
  EXPECT_EQ(score.total.no_decision, 1.0);
}

}  // namespace
}  // namespace eval
