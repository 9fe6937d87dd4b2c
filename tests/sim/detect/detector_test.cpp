#include "sim/detect/detector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "sim/detect/confusions.h"
#include "sim/detect/slow_noise.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

ObjectInFrame Seen(int id, int pixels, int unoccluded, const PixelBox& box) {
  ObjectInFrame object;
  object.id = id;
  object.pixels = pixels;
  object.unoccluded_pixels = unoccluded;
  object.visible_box = object.amodal_box = box;
  object.visible_fraction = static_cast<double>(pixels) / unoccluded;
  return object;
}

Scene LaptopOnDesk() {
  Scene scene;
  scene.objects = {BoxObject(1, "desk", Role::kStructure, {0, 0, 0}, {1, 1, 1}),
                   BoxObject(2, "laptop", Role::kRegular, {0, 0, 0}, {1, 1, 1}),
                   BoxObject(3, "laptop", Role::kRegular, {0, 0, 0}, {1, 1, 1}),
                   BoxObject(4, "teddy bear", Role::kUnstructured, {0, 0, 0}, {1, 1, 1}),
                   BoxObject(5, "cup", Role::kOther, {0, 0, 0}, {1, 1, 1})};
  scene.objects[1].detection_group = scene.objects[2].detection_group = 1;
  return scene;
}

FrameTruth AllSeen() {
  return {{Seen(1, 90000, 90000, {0, 0, 639, 479}), Seen(2, 9000, 9000, {100, 100, 200, 190}),
           Seen(3, 9000, 9000, {90, 40, 210, 100}), Seen(4, 2500, 2500, {400, 100, 450, 150}),
           Seen(5, 2500, 2500, {500, 100, 550, 150})},
          {},
          {{1, 18000}}};
}

TEST(PerfectDetector, BoxesWhatIsVisibleOfGroupsAndToysAlone) {
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kPerfect, 1);
  const auto detections = detector.Detect(0, AllSeen());
  ASSERT_EQ(detections.size(), 2u);
  EXPECT_EQ(detections[0].class_name, "laptop");
  EXPECT_EQ(detections[0].box, (PixelBox{90, 40, 210, 190}));
  EXPECT_EQ(detections[0].score, 1.0);
  EXPECT_EQ(detections[1].class_name, "teddy bear");
  EXPECT_EQ(detections[1].box, (PixelBox{400, 100, 450, 150}));
}

TEST(PerfectDetector, BoxesTheLidAloneWhenTheBaseIsHidden) {
  FrameTruth truth = AllSeen();
  truth.objects.erase(truth.objects.begin() + 1);
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kPerfect, 1);
  EXPECT_EQ(detector.Detect(0, truth)[0].box, (PixelBox{90, 40, 210, 100}));
}

TEST(PerfectDetector, TakesPartsOfRoleOtherForTheThingThatTheyAreGroupedWith) {
  Scene scene = LaptopOnDesk();
  scene.objects[4].detection_group = 1;
  std::rotate(scene.objects.begin(), scene.objects.end() - 1, scene.objects.end());
  FrameTruth truth = AllSeen();
  truth.unoccluded_pixels_of_group[1] = 20500;
  const Detector detector(scene, Camera{}, DetectorKind::kPerfect, 1);
  const auto targets = detector.VisibleTargets(truth);
  ASSERT_EQ(targets.size(), 2u);
  EXPECT_EQ(targets[0].key, 2u);  // begun by what can be detected by itself
  EXPECT_EQ(targets[0].class_name, "laptop");
  EXPECT_EQ(targets[0].pixels, 20500);
  EXPECT_EQ(targets[0].box, (PixelBox{90, 40, 550, 190}));
}

TEST(PerfectDetector, LeavesAGroupOfRoleOtherAlone) {
  Scene scene = LaptopOnDesk();
  scene.objects[4].detection_group = 2;
  FrameTruth truth = AllSeen();
  truth.unoccluded_pixels_of_group[2] = 2500;
  const Detector detector(scene, Camera{}, DetectorKind::kPerfect, 1);
  EXPECT_EQ(detector.VisibleTargets(truth).size(), 2u);
}

// The lid stands before 3000 pixels of the base: together they would show 15000.
TEST(PerfectDetector, CountsWhatOnePartHidesOfAnotherAsNoneHidden) {
  FrameTruth truth = AllSeen();
  truth.objects[1].pixels = 6000;
  truth.unoccluded_pixels_of_group[1] = 15000;
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kPerfect, 1);
  EXPECT_EQ(detector.VisibleTargets(truth)[0].VisibleFraction(), 1.0);
}

TEST(PerfectDetector, LeavesOutWhatIsTooSmallToSee) {
  FrameTruth truth;
  truth.objects = {Seen(4, 59, 900, {400, 100, 410, 106})};
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kPerfect, 1);
  EXPECT_TRUE(detector.Detect(0, truth).empty());
}

TEST(PerfectDetector, SeesAsSmallThingsInAnImageOfAnotherSize) {
  const Camera quarter = Resize(Camera{}, 160, 120);  // of 60 pixels 3.75 are left
  const Detector detector(LaptopOnDesk(), quarter, DetectorKind::kPerfect, 1);
  for (const int pixels : {3, 4}) {
    FrameTruth truth;
    truth.objects = {Seen(4, pixels, 4, {100, 25, 109, 34})};
    EXPECT_EQ(detector.Detect(0, truth).size(), pixels == 4 ? 1u : 0u) << pixels;
  }
}

TEST(NoDetector, ReportsNothing) {
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNone, 1);
  EXPECT_TRUE(detector.Detect(0, AllSeen()).empty());
}

constexpr int kFrames = 6000;

/// Share of frames without the teddy when it shows `pixels` of `unoccluded`.
std::vector<bool> Misses(int pixels, int unoccluded) {
  DetectorModel model;
  model.phantom = model.duplicate = model.confused = 0;
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 3, model);
  FrameTruth truth;
  truth.objects = {Seen(4, pixels, unoccluded, {300, 200, 360, 260})};
  std::vector<bool> missed;
  for (int frame = 0; frame < kFrames; ++frame) {
    missed.push_back(detector.Detect(frame, truth).empty());
  }
  return missed;
}
double Share(const std::vector<bool>& missed) {
  return static_cast<double>(std::count(missed.begin(), missed.end(), true)) / kFrames;
}

// Runs of 8 frames: about 750 independent ones, so a share p has a standard error of about
// sqrt(p / 750); five of them.
TEST(NoisyDetector, MissesAsItsModelSays) {
  const DetectorModel model;
  for (const auto& [pixels, whole] : {std::pair{400, 400}, {3600, 3600}, {3600, 14400}}) {
    const double hidden = 1 - static_cast<double>(pixels) / whole;
    const double expected =
        1 - (1 - model.base_miss) *
                (1 - model.small_miss * std::exp(-std::sqrt(pixels) / model.small_size_px)) *
                (1 - model.hidden_miss * hidden * hidden);
    EXPECT_NEAR(Share(Misses(pixels, whole)), expected, 5 * std::sqrt(expected / 750));
  }
}

TEST(NoisyDetector, MissesInRuns) {
  const std::vector<bool> missed = Misses(900, 900);
  int both = 0;
  for (std::size_t i = 1; i < missed.size(); ++i) both += missed[i] && missed[i - 1] ? 1 : 0;
  const double again = both / (Share(missed) * kFrames);
  EXPECT_GT(again, 2 * Share(missed));
  EXPECT_GT(again, 0.6);
}

TEST(NoisyDetector, JittersInProportionToTheBox) {
  DetectorModel model;
  model.phantom = model.duplicate = model.confused = model.base_miss = model.small_miss = 0;
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 3, model);
  FrameTruth truth;
  truth.objects = {Seen(4, 20000, 20000, {200, 100, 400, 200})};
  double x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const PixelBox box = detector.Detect(frame, truth).at(0).box;
    x0 += (box.x0 - 200) * (box.x0 - 200), y0 += (box.y0 - 100) * (box.y0 - 100);
    x1 += (box.x1 - 400) * (box.x1 - 400), y1 += (box.y1 - 200) * (box.y1 - 200);
  }
  // sd 0.02 * 200 + 0.5 and 0.02 * 100 + 0.5; half the variance has 750 independent draws.
  for (const double x : {x0, x1}) EXPECT_NEAR(std::sqrt(x / kFrames), 4.5, 0.4);
  for (const double y : {y0, y1}) EXPECT_NEAR(std::sqrt(y / kFrames), 2.5, 0.25);
}

TEST(NoisyDetector, IsLessSureOfWhatIsHiddenByTheShareThatIs) {
  DetectorModel model;
  model.phantom = model.duplicate = model.confused = 0;
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 3, model);
  const auto mean_score = [&](int unoccluded) {
    FrameTruth truth;
    truth.objects = {Seen(4, 3600, unoccluded, {300, 200, 360, 260})};
    double sum = 0, count = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      for (const Detection& d : detector.Detect(frame, truth)) sum += d.score, count += 1;
    }
    return sum / count;
  };
  // 0.4 of a thing of 60 px, which is 20 px for half of it.
  EXPECT_NEAR(mean_score(3600), 0.55 + 0.4 * 0.75, 0.005);
  EXPECT_NEAR(mean_score(7200), 0.55 + 0.4 * 0.75 / 2, 0.005);
}

// What is not there is seen for four frames in the same place, more or less, and is one thing.
TEST(NoisyDetector, SeesWhatIsNotThereForSomeFramesOnEnd) {
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kPoor, 4, PoorDetector());
  int phantoms = 0;
  for (int window = 0; window < 500; ++window) {
    const auto first = detector.Detect(4 * window, {});
    ASSERT_LE(first.size(), 1u);
    for (int frame = 4 * window + 1; frame < 4 * window + 4; ++frame) {
      const auto next = detector.Detect(frame, {});
      ASSERT_EQ(next.size(), first.size()) << frame;
      if (first.empty()) continue;
      EXPECT_EQ(next[0].class_name, first[0].class_name);
      EXPECT_NEAR(next[0].box.x0, first[0].box.x0, 60);
      EXPECT_NEAR(next[0].box.y1, first[0].box.y1, 60);
    }
    phantoms += first.empty() ? 0 : 1;
  }
  // The stated 12 % of 500, to five standard deviations.
  EXPECT_NEAR(phantoms, 60, 5 * std::sqrt(500 * 0.12 * 0.88));
}

TEST(NoisyDetector, DoublesConfusesAndInventsAtTheStatedRates) {
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 4);
  FrameTruth truth;
  truth.objects = {Seen(4, 20000, 20000, {200, 100, 400, 200})};
  int confused = 0, extra = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto detections = detector.Detect(frame, truth);
    for (const Detection& d : detections) {
      confused += d.class_name == "dog" || d.class_name == "person" ? 1 : 0;
      EXPECT_TRUE(d.box.x0 >= 0 && d.box.y0 >= 0 && d.box.x1 <= 639 && d.box.y1 <= 479);
      EXPECT_TRUE(d.score > 0.1 && d.score < 1);
    }
    extra += detections.size() > 1 ? 1 : 0;
  }
  EXPECT_GT(confused, kFrames / 200);
  EXPECT_LT(confused, kFrames / 20);
  EXPECT_GT(extra, kFrames / 100);
  EXPECT_LT(extra, kFrames / 12);
}

TEST(NoisyDetector, PlacesADoubleByItselfAndThreeTimesAsBadly) {
  DetectorModel model;
  model.phantom = model.confused = model.base_miss = model.small_miss = 0;
  model.duplicate = 1;
  const Detector detector(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 3, model);
  FrameTruth truth;
  truth.objects = {Seen(4, 20000, 20000, {200, 100, 400, 200})};
  double first2 = 0, second2 = 0, both = 0;
  for (int frame = 0; frame < kFrames; ++frame) {
    const auto detections = detector.Detect(frame, truth);  // the double has the lesser score
    ASSERT_EQ(detections.size(), 2u);
    const double first = detections[0].box.x0 - 200, second = detections[1].box.x0 - 200;
    first2 += first * first, second2 += second * second, both += first * second;
  }
  EXPECT_NEAR(std::sqrt(second2 / first2), 3.0, 0.4);
  EXPECT_NEAR(both / std::sqrt(first2 * second2), 0.0, 0.2);  // 750 independent draws
}

// A quarter of the pixels in an image of half the size is the same view of the same thing.
TEST(NoisyDetector, IsAsSureOfAThingInAnImageOfAnotherSize) {
  for (const DetectorKind kind : {DetectorKind::kNoisy, DetectorKind::kPoor}) {
    DetectorModel model = ModelOf(kind);
    model.phantom = model.duplicate = 0;
    const auto seen_at = [&](int percent) {
      const Camera camera = Resize(Camera{}, 640 * percent / 100, 480 * percent / 100);
      const Detector detector(LaptopOnDesk(), camera, kind, 3, model);
      const auto part = [&](int pixels) { return pixels * percent * percent / 10000; };
      const double side = percent / 100.0;
      FrameTruth truth;
      truth.objects = {
          Seen(4, part(3600), part(4800), {200 * side, 100 * side, 270 * side, 160 * side})};
      std::vector<std::vector<Detection>> frames;
      for (int frame = 0; frame < 200; ++frame) frames.push_back(detector.Detect(frame, truth));
      return frames;
    };
    const auto usual = seen_at(100);
    for (const int percent : {25, 50, 200}) {
      SCOPED_TRACE(percent);
      const auto other = seen_at(percent);
      int detections = 0;
      for (std::size_t i = 0; i < usual.size(); ++i) {
        ASSERT_EQ(other[i].size(), usual[i].size()) << i;
        for (std::size_t k = 0; k < usual[i].size(); ++k, ++detections) {
          ASSERT_NEAR(other[i][k].score, usual[i][k].score, 0.0011) << i;  // told to 0.001
        }
      }
      EXPECT_GT(detections, 20);
    }
  }
}

TEST(NoisyDetector, GivesAFrameTheSameAnswerInAnyOrder) {
  const Detector a(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 4);
  const Detector b(LaptopOnDesk(), Camera{}, DetectorKind::kNoisy, 4);
  std::vector<std::string> forward;
  for (int frame = 0; frame < 40; ++frame)
    forward.push_back(DetectionsJson(0, a.Detect(frame, AllSeen())));
  for (int frame = 39; frame >= 0; --frame) {
    EXPECT_EQ(DetectionsJson(0, b.Detect(frame, AllSeen())),
              forward[static_cast<std::size_t>(frame)]);
  }
}

TEST(Confusions, NeverNameTheClassItself) {
  for (const char* name : {"book", "keyboard", "tv", "laptop", "cell phone", "remote", "mouse",
                           "teddy bear", "potted plant", "box"}) {
    for (const char* other : ConfusedWith(name)) EXPECT_STRNE(other, name);
  }
}

TEST(SlowNoise, IsStandardNormalAndRemembersItsRun) {
  double sum = 0, squares = 0, next = 0;
  constexpr int kCount = 40000;
  const SlowNoise noise(5, 8);
  for (int frame = 0; frame < kCount; ++frame) {
    const double x = noise.Normal(frame);
    sum += x;
    squares += x * x;
    next += x * noise.Normal(frame + 1);
  }
  EXPECT_NEAR(sum / kCount, 0, 5 / std::sqrt(kCount / 8.0));
  EXPECT_NEAR(squares / kCount, 1, 5 * std::sqrt(2 / (kCount / 8.0)));
  EXPECT_GT(next / kCount, 0.8);
}

// Between its knots a stream bends, so its steps are unequal; of many streams they are alike at
// every frame, as each has its knots elsewhere.
TEST(SlowNoise, OfManyStreamsMovesAsMuchAtOneFrameAsAtAnother) {
  constexpr int kRun = 8, kStreams = 3000;
  double moved[kRun] = {}, mean = 0;
  for (int key = 0; key < kStreams; ++key) {
    const SlowNoise noise(static_cast<std::uint64_t>(key), kRun);
    for (int frame = 0; frame < kRun; ++frame) {
      const double step = noise.Normal(frame + 1) - noise.Normal(frame);
      moved[frame] += step * step / kStreams;
      mean += step * step / kStreams / kRun;
    }
  }
  // A squared normal has a relative sd of sqrt 2, a mixture of narrow and wide ones somewhat more.
  for (const double one : moved) EXPECT_NEAR(one, mean, 5 * 2 * mean / std::sqrt(kStreams));
}

TEST(DetectionsJson, HoldsTheFormatsKeys) {
  const auto json =
      nlohmann::json::parse(DetectionsJson(0.033333, {{"book", 0.91, {1, 2, 3, 4.5}}}));
  EXPECT_EQ(json["timestamp"], 0.033333);
  EXPECT_EQ(json["detections"][0]["class"], "book");
  EXPECT_EQ(json["detections"][0]["score"], 0.91);
  EXPECT_EQ(json["detections"][0]["box"], (std::vector<double>{1, 2, 3, 4.5}));
}

}  // namespace
}  // namespace sim
