#include "app/live/live_scene.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/read_file.h"
#include "sim/families/families.h"
#include "sim/write/write_sequence.h"
#include "slam/run/run_sequence.h"
#include "tests/support/temporary_folder.h"

namespace app {
namespace {

namespace fs = std::filesystem;

/// A recording with everything that could differ between memory and files: a lens, blur, lost
/// frames, wrong stamps, depth that comes late.
sim::SequenceOptions Awkward() {
  sim::SequenceOptions options;
  options.rig.camera =
      sim::WithLens(sim::Resize(sim::Camera{}, 320, 240), {0.05, -0.02, 0.001, -0.001, 0});
  options.rig.seed = 5;
  options.rig.sensor.exposure.drift_stops = 0.5;
  options.rig.sensor.timing.drop_ratio = 0.2;
  options.rig.sensor.timing.stamp_jitter_s = 0.001;
  options.rig.sensor.timing.depth_offset_s = 0.005;
  options.frames = 9;
  options.threads = 2;
  return options;
}

class SceneRunLive : public testing::Test {
 protected:
  sim::Recording Plan(const sim::SequenceOptions& o) const {
    return sim::PlanRecording(scene_, o.rig, o.frames);
  }
  void RunLive(const sim::SequenceOptions& o, const std::string& name, int ahead) {
    LiveScene live(scene_, o.rig, Plan(o), ahead);
    slam::RunOptions run;
    run.sequence = "scene";
    run.run = root_ / name;
    slam::RunLive({live, live.camera(), live.MakeDetector(run.config.classes)}, run);
  }

  const sim::Scene scene_ = sim::MakeScene("desk", 3);
  test_support::TemporaryFolder temporary_;
  const fs::path root_ = temporary_.path();
};

TEST_F(SceneRunLive, GivesTheRunThatTheFilesOfTheSameRecordingGive) {
  for (const bool awkward : {false, true}) {
    sim::SequenceOptions options = Awkward();
    if (!awkward) {
      const sim::RigOptions plain;
      options.rig.camera = sim::Resize(plain.camera, 320, 240);
      options.rig.sensor.exposure = {};
      options.rig.sensor.timing = {};
      options.frames = 6;
    }
    const std::string tag = awkward ? "awkward" : "plain";
    sim::WriteSequence(scene_, options, root_ / tag);
    slam::RunOptions run;
    run.sequence = root_ / tag;
    run.run = root_ / (tag + "_files");
    run.config.first_look.frames = 0;  // frames that are rendered come once
    const slam::RunOutcome outcome = slam::RunSequence(run);
    ASSERT_GT(outcome.tracked, 3);
    ASSERT_GT(outcome.map_planes + outcome.keyframes, 0);
    RunLive(options, tag + "_live", 2);
    for (const char* file :
         {"trajectory.txt", "keyframes.txt", "frame_planes.jsonl", "map.json", "map.ply"}) {
      EXPECT_EQ(io::ReadFile(root_ / (tag + "_files") / file),
                io::ReadFile(root_ / (tag + "_live") / file))
          << tag << " " << file;
    }
  }
}

TEST_F(SceneRunLive, GivesTheSameFramesHoweverFarItRendersAhead) {
  const sim::SequenceOptions options = Awkward();
  LiveScene none(scene_, options.rig, Plan(options), 0);
  LiveScene three(scene_, options.rig, Plan(options), 3);
  const auto seen_none = none.MakeDetector(slam::CocoClassTable());
  const auto seen_three = three.MakeDetector(slam::CocoClassTable());
  std::size_t boxes = 0;
  for (int i = 0; i < none.size(); ++i) {
    const slam::RecordedFrame a = none.Read(i), b = three.Read(i);
    EXPECT_EQ(a.timestamp_s, b.timestamp_s);
    EXPECT_EQ(cv::norm(a.bgr, b.bgr, cv::NORM_INF), 0);
    EXPECT_EQ(cv::norm(a.depth_m, b.depth_m, cv::NORM_INF), 0);
    const auto x = seen_none->Detect(a.timestamp_s, a.bgr);
    const auto y = seen_three->Detect(b.timestamp_s, b.bgr);
    ASSERT_EQ(x.size(), y.size());
    for (std::size_t j = 0; j < x.size(); ++j) EXPECT_EQ(x[j].box_px.min, y[j].box_px.min);
    boxes += x.size();
  }
  EXPECT_GT(boxes, 0u);
  EXPECT_LT(none.size(), options.frames);  // some were lost, as asked
}

TEST_F(SceneRunLive, RefusesFramesOutOfOrderAndTheDetectionsOfAnother) {
  const sim::SequenceOptions options = Awkward();
  LiveScene live(scene_, options.rig, Plan(options), 1);
  EXPECT_THROW(live.Read(1), std::logic_error);
  const slam::RecordedFrame first = live.Read(0);
  EXPECT_THROW(live.Read(0), std::logic_error);
  const auto detector = live.MakeDetector(slam::CocoClassTable());
  EXPECT_THROW(detector->Detect(first.timestamp_s + 1, first.bgr), std::logic_error);
}

TEST_F(SceneRunLive, HasNoDetectorWhereTheRigHasNone) {
  sim::SequenceOptions options = Awkward();
  options.rig.detector = sim::DetectorKind::kNone;
  EXPECT_EQ(
      LiveScene(scene_, options.rig, Plan(options), 0).MakeDetector(slam::CocoClassTable()),
      nullptr);
}

}  // namespace
}  // namespace app
