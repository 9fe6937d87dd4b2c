#include "sim/detect/detector_score.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/detect/slow_noise.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr PixelBox kHere{100, 100, 200, 200};

DetectionTarget Thing(std::uint64_t key, const PixelBox& box, int pixels = 5000) {
  return {key, "book", pixels, pixels, box};
}

TEST(BoxIou, IsTheSharedPartOfTheUnion) {
  EXPECT_DOUBLE_EQ(BoxIou(kHere, kHere), 1);
  EXPECT_DOUBLE_EQ(BoxIou(kHere, {150, 100, 250, 200}), 1.0 / 3);
  EXPECT_EQ(BoxIou(kHere, {200, 100, 300, 200}), 0);
}

TEST(DetectorScore, TellsFoundDoubledInventedAndMisnamedApart) {
  DetectorScore score;
  score.Add({Thing(1, kHere), Thing(2, {300, 300, 320, 320}, 300)},
            {{"book", 0.9, {105, 100, 200, 200}},
             {"laptop", 0.8, {100, 100, 200, 190}},
             {"laptop", 0.7, {300, 300, 321, 320}},
             {"book", 0.6, {400, 10, 450, 60}}});
  EXPECT_EQ(score.all().targets, 2);
  EXPECT_EQ(score.all().found, 2);
  EXPECT_EQ(score.all().right_class, 1);  // the better of two boxes names the class
  EXPECT_EQ(score.doubles(), 1);
  EXPECT_EQ(score.phantoms(), 1);
  EXPECT_DOUBLE_EQ(score.Precision(), 0.5);
  EXPECT_EQ(score.by_size()[0].targets, 1);
  EXPECT_EQ(score.by_size()[1].targets, 1);
  EXPECT_NEAR(score.all().MeanIou(), (0.95 + 20.0 / 21.0) / 2, 1e-12);
}

// COCO's limits, 32 and 96 pixels squared, are those of a 640 x 480 image of the same view.
TEST(DetectorScore, SortsTargetsBySizeAsInAnImageOf640By480) {
  for (const double scale : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    SCOPED_TRACE(scale);
    DetectorScore score(scale);
    std::vector<DetectionTarget> targets;
    for (const int side : {20, 28, 36, 60, 92, 100}) {
      targets.push_back(
          Thing(targets.size() + 1, kHere, static_cast<int>(side * scale * (side * scale))));
    }
    score.Add(targets, {});
    EXPECT_EQ(score.by_size()[0].targets, 2);
    EXPECT_EQ(score.by_size()[1].targets, 3);
    EXPECT_EQ(score.by_size()[2].targets, 1);
  }
}

TEST(DetectorScore, CountsARunOfMissesOnceAndNotAcrossRecordings) {
  DetectorScore score;
  const std::vector<DetectionTarget> there{Thing(1, kHere)};
  const std::vector<Detection> seen{{"book", 0.9, kHere}};
  for (const bool found : {false, false, true, false}) {
    score.Add(there, found ? seen : std::vector<Detection>{});
  }
  EXPECT_EQ(score.all().runs, 2);
  EXPECT_DOUBLE_EQ(score.all().MeanMissRun(), 1.5);
  score.NextRecording();
  score.Add(there, {});
  EXPECT_EQ(score.all().runs, 3);
  score.Add({}, {});  // out of view: the run is over
  score.Add(there, {});
  EXPECT_EQ(score.all().runs, 4);
}

/// A scene of many equal toys, so that few frames give many draws.
constexpr int kThings = 60, kPresetFrames = 800;

DetectorScore ScoreOf(DetectorKind kind, const DetectorModel& model, int pixels, int whole) {
  Scene scene;
  FrameTruth truth;
  for (int i = 0; i < kThings; ++i) {
    scene.objects.push_back(
        BoxObject(i + 1, "teddy bear", Role::kUnstructured, {0, 0, 0}, {1, 1, 1}));
    const double x = 10 + 60 * (i % 10), y = 10 + 70 * (i / 10);
    ObjectInFrame seen;
    seen.id = i + 1;
    seen.pixels = pixels, seen.unoccluded_pixels = whole;
    seen.visible_box = seen.amodal_box = {x, y, x + 50, y + 60};
    truth.objects.push_back(seen);
  }
  const Detector detector(scene, Camera{}, kind, 11, model);
  DetectorScore score;
  for (int frame = 0; frame < kPresetFrames; ++frame) {
    score.Add(detector.VisibleTargets(truth), detector.Detect(frame, truth));
  }
  return score;
}

/// Draws that are worth one: runs of `run` frames, knots at most that far apart.
double Draws(int run) { return static_cast<double>(kThings) * kPresetFrames / (2.0 * run); }
double Band(double p, int run) { return 5 * std::sqrt(p * (1 - p) / Draws(run)); }

TEST(DetectorPresets, MissMisnameAndDoubleAtTheirStatedRates) {
  for (const DetectorKind kind : {DetectorKind::kNoisy, DetectorKind::kPoor}) {
    const DetectorModel model = ModelOf(kind);
    const DetectorScore score = ScoreOf(kind, model, 2500, 3600);
    const double hidden = 1 - 2500.0 / 3600;
    const double missed = 1 - (1 - model.base_miss) *
                                  (1 - model.small_miss * std::exp(-50 / model.small_size_px)) *
                                  (1 - model.hidden_miss * hidden * hidden);
    EXPECT_NEAR(1 - score.all().Recall(), missed, Band(missed, model.miss_run_frames));
    EXPECT_NEAR(1 - score.all().RightShare(), model.confused,
                Band(model.confused, 2 * model.miss_run_frames));
    // A double may be so loose that it counts as a phantom: both kinds of extra boxes at once.
    const double found = static_cast<double>(score.all().found);
    const double expected = model.duplicate * found + model.phantom * kPresetFrames;
    const double band = Band(model.duplicate, model.duplicate_run_frames) * found +
                        5 * 4 * std::sqrt(model.phantom * kPresetFrames / 4.0);
    EXPECT_NEAR(static_cast<double>(score.doubles() + score.phantoms()), expected, band);
    EXPECT_GT(expected, band);
  }
}

// The test that a detector which draws every frame alone fails: its runs are 1 / (1 - m) long.
TEST(DetectorPresets, MissInRunsMuchLongerThanIndependentFramesWould) {
  for (const DetectorKind kind : {DetectorKind::kNoisy, DetectorKind::kPoor}) {
    const DetectorScore score = ScoreOf(kind, ModelOf(kind), 2500, 3600);
    EXPECT_GT(score.all().MeanMissRun(), 2 * score.all().IndependentMissRun());
    DetectorModel alone = ModelOf(kind);
    alone.miss_run_frames = 1;
    const DetectorScore control = ScoreOf(kind, alone, 2500, 3600);
    EXPECT_NEAR(control.all().MeanMissRun(), control.all().IndependentMissRun(),
                0.15 * control.all().IndependentMissRun());
  }
}

TEST(DetectorPresets, AreOrderedFromPerfectToPoor) {
  const DetectorScore perfect = ScoreOf(DetectorKind::kPerfect, {}, 2500, 3600);
  const DetectorScore noisy = ScoreOf(DetectorKind::kNoisy, {}, 2500, 3600);
  const DetectorScore poor =
      ScoreOf(DetectorKind::kPoor, ModelOf(DetectorKind::kPoor), 2500, 3600);
  EXPECT_EQ(perfect.all().Recall(), 1);
  EXPECT_EQ(perfect.Precision(), 1);
  EXPECT_EQ(perfect.all().MeanIou(), 1);
  EXPECT_LT(noisy.all().Recall(), 1);
  EXPECT_LT(poor.all().Recall(), noisy.all().Recall() - 0.1);
  EXPECT_LT(poor.all().MeanIou(), noisy.all().MeanIou() - 0.03);
  EXPECT_LT(poor.Precision(), noisy.Precision());
}

TEST(DetectorPresets, MissTheSmallAndTheHiddenMoreOften) {
  for (const DetectorKind kind : {DetectorKind::kNoisy, DetectorKind::kPoor}) {
    const auto recall = [&](int pixels, int whole) {
      return ScoreOf(kind, ModelOf(kind), pixels, whole).all().Recall();
    };
    const double large = recall(9000, 9000);
    EXPECT_GT(large, recall(600, 600) + 0.05);
    EXPECT_GT(large, recall(9000, 36000) + 0.05);
  }
}

TEST(SlowNoise, HasTheSameShareBelowAThresholdBetweenKnotsAsOnThem) {
  int below = 0;
  constexpr int kCount = 60000, kRun = 8;
  for (int key = 0; key < kCount; ++key) {
    below += SlowNoise(static_cast<std::uint64_t>(key), kRun).Uniform(3) < 0.1 ? 1 : 0;
  }
  EXPECT_NEAR(below / static_cast<double>(kCount), 0.1, 5 * std::sqrt(0.09 / kCount));
}

}  // namespace
}  // namespace sim
