#include "slam/detect/box_tracks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "slam/base/random.h"
#include "slam/detect/box_assignment.h"

namespace slam {
namespace {

const Box kImage{{0, 0}, {639, 479}};
constexpr double kFrame_s = 1.0 / 30;

Detection Seen(const std::string& name, double u, double v, double w = 80, double h = 60) {
  return {.class_name = name,
          .kind = ClassKind::kRegular,
          .score = 0.9,
          .box_px = {{u, v}, {u + w, v + h}}};
}

/// Boxes of a desk under a moving hand-held camera: a common sway, a parallax of their own,
/// growth.
struct MovingDesk {
  std::uint64_t seed;
  double sway_px = 120;  ///< amplitude; with 0.7 Hz up to 18 px a frame

  /// True visible boxes at a frame; objects that left the image are absent.
  std::vector<Detection> At(int frame) const {
    static constexpr const char* kNames[] = {"book", "book",   "keyboard", "cell phone",
                                             "tv",   "laptop", "book",     "mouse"};
    const double t = frame * kFrame_s;
    std::vector<Detection> boxes;
    for (std::uint64_t i = 0; i < 8; ++i) {
      Random random{seed, i};
      const double u0 = 40 + 140.0 * static_cast<double>(i % 4) + 20 * random.Uniform();
      const double v0 = 90 + 170.0 * static_cast<double>(i / 4) + 20 * random.Uniform();
      const double w = 50 + 70 * random.Uniform(), h = 35 + 60 * random.Uniform();
      const double near = 0.8 + 0.4 * random.Uniform();
      const double u = u0 + near * sway_px * std::sin(4.4 * t);
      const double v = v0 + near * 0.6 * sway_px * std::sin(3.1 * t + 1.0);
      const double grow = 1 + 0.15 * std::sin(1.3 * t);
      Detection d = Seen(kNames[i], u, v, w * grow, h * grow);
      d.box_px = Intersection(d.box_px, kImage);
      if (d.box_px.area() > 0.3 * w * h) boxes.push_back(d);
    }
    return boxes;
  }
};

/// Misses at random, jitters, and invents a box now and then.
std::vector<Detection> Noisy(const std::vector<Detection>& truth, double miss_rate,
                             Random& random) {
  std::vector<Detection> seen;
  for (Detection d : truth) {
    const bool missed = random.Uniform() < miss_rate;
    for (double* side :
         {&d.box_px.min.x(), &d.box_px.min.y(), &d.box_px.max.x(), &d.box_px.max.y()})
      *side += 4 * (random.Uniform() + random.Uniform() - 1);
    d.box_px = Intersection(d.box_px, kImage);
    if (!missed) seen.push_back(d);
  }
  if (random.Uniform() < 0.1)
    seen.push_back(Seen("book", 500 * random.Uniform(), 380 * random.Uniform()));
  return seen;
}

struct Score {
  double true_positive = 0, given = 0, truth = 0;
  double precision() const { return true_positive / given; }
  double recall() const { return true_positive / truth; }
};

/// Right is: the class, and IoU of at least 0.5, one to one.
void Add(const std::vector<Detection>& truth, const std::vector<Detection>& found,
         Score& score) {
  std::vector<std::vector<double>> gain(truth.size(), std::vector<double>(found.size(), 0.0));
  for (std::size_t i = 0; i < truth.size(); ++i)
    for (std::size_t j = 0; j < found.size(); ++j)
      if (truth[i].class_name == found[j].class_name &&
          Iou(truth[i].box_px, found[j].box_px) >= 0.5)
        gain[i][j] = 1;
  for (const int j : AssignForLargestGain(gain)) score.true_positive += j >= 0;
  score.truth += static_cast<double>(truth.size());
  score.given += static_cast<double>(found.size());
}

struct Comparison {
  Score plain, tracked;
};

Comparison Measure(double miss_rate) {
  Comparison result;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const MovingDesk desk{seed};
    BoxTracks tracks({}, kImage);
    Random random{77, seed, static_cast<std::uint64_t>(100 * miss_rate)};
    for (int frame = 0; frame < 300; ++frame) {
      const auto truth = desk.At(frame);
      const auto seen = Noisy(truth, miss_rate, random);
      Add(truth, seen, result.plain);
      Add(truth, tracks.Update(frame * kFrame_s, seen), result.tracked);
    }
  }
  return result;
}

TEST(BoxTracks, RecoversMissedBoxesAtEveryMissRateWithoutInventingMany) {
  for (const double miss_rate : {0.0, 0.1, 0.2, 0.3, 0.4, 0.5}) {
    const auto [plain, tracked] = Measure(miss_rate);
    std::printf("miss rate %.0f %%: recall %.3f -> %.3f, precision %.3f -> %.3f\n",
                100 * miss_rate, plain.recall(), tracked.recall(), plain.precision(),
                tracked.precision());
    // Of what was missed at least three quarters come back up to 30 %, half up to 50 %.
    const double regained = (tracked.recall() - plain.recall()) / (1 - plain.recall() + 1e-9);
    if (miss_rate > 0) {
      EXPECT_GT(regained, miss_rate <= 0.3 ? 0.75 : 0.5);
    }
    EXPECT_GE(tracked.recall(), plain.recall());
    EXPECT_GT(tracked.precision(), plain.precision() - 0.04);
  }
}

TEST(BoxTracks, FillsASingleMissWhereTheBoxHasMovedTo) {
  BoxTracks tracks({}, kImage);
  for (int i = 0; i < 10; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100 + 6 * i, 200)});
  const auto answer = tracks.Update(10 * kFrame_s, {});
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_TRUE(answer[0].compensated);
  EXPECT_EQ(answer[0].class_name, "book");
  EXPECT_EQ(answer[0].kind, ClassKind::kRegular);
  EXPECT_LT(answer[0].score, 0.9);
  EXPECT_GT(Iou(answer[0].box_px, Seen("book", 160, 200).box_px), 0.9);
}

// A second of boxes that jitter by 1.6 px. The textbook's filter with these settings, worked out
// apart from this program, is 1.9 px off two frames later, and 5.4 px if it never trusts its speed.
TEST(BoxTracks, FillsABoxAtRestWhereItRestsThoughTheDetectorJitters) {
  constexpr int kSeen = 30, kGap = 2, kDraws = 50;
  double sum2 = 0.0;
  for (std::uint64_t draw = 0; draw < kDraws; ++draw) {
    Random random{41, draw};
    const std::vector<Detection> rest{Seen("book", 300, 200)};
    BoxTracks tracks({}, kImage);
    for (int i = 0; i < kSeen; ++i) {
      Detection seen = rest[0];
      for (double* side : {&seen.box_px.min.x(), &seen.box_px.min.y(), &seen.box_px.max.x(),
                           &seen.box_px.max.y()})
        *side += 4 * (random.Uniform() + random.Uniform() - 1);
      tracks.Update(i * kFrame_s, {seen});
    }
    std::vector<Detection> filled;
    for (int i = kSeen; i < kSeen + kGap; ++i) filled = tracks.Update(i * kFrame_s, {});
    ASSERT_EQ(filled.size(), 1u);
    sum2 += (filled[0].box_px.min - rest[0].box_px.min).squaredNorm() / 2;
  }
  EXPECT_LT(std::sqrt(sum2 / kDraws), 2.5);
}

TEST(BoxTracks, MovesAMissedBoxWithTheOthersWhenTheHandJerks) {
  BoxTracks tracks({}, kImage);
  const auto desk = [](double shift) {
    return std::vector<Detection>{Seen("keyboard", 40 + shift, 300, 200),
                                  Seen("tv", 200 + shift, 40, 200, 150),
                                  Seen("laptop", 330 + shift, 250, 150, 120)};
  };
  for (int i = 0; i < 10; ++i) {
    auto seen = desk(0);
    seen.push_back(Seen("cell phone", 120, 200, 30, 20));
    tracks.Update(i * kFrame_s, seen);
  }
  const auto answer = tracks.Update(10 * kFrame_s, desk(50));
  ASSERT_EQ(answer.size(), 4u);
  EXPECT_TRUE(answer[3].compensated);
  EXPECT_GT(Iou(answer[3].box_px, Seen("cell phone", 170, 200, 30, 20).box_px), 0.7);
}

TEST(BoxTracks, GivesUpAnObjectThatIsGone) {
  BoxTracks tracks({}, kImage);
  for (int i = 0; i < 30; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  int filled = 0;
  for (int i = 30; i < 60; ++i)
    filled += static_cast<int>(tracks.Update(i * kFrame_s, {}).size());
  EXPECT_LE(filled, BoxTracksConfig{}.max_gap_frames);
  // Its track has ended: seen once more it is new, and not filled.
  EXPECT_EQ(tracks.Update(60 * kFrame_s, {Seen("book", 100, 200)}).size(), 1u);
  EXPECT_TRUE(tracks.Update(61 * kFrame_s, {}).empty());
}

TEST(BoxTracks, FillsLongerForAnObjectThatIsOftenMissed) {
  const auto filled_after = [](int period) {
    BoxTracks tracks({}, kImage);
    for (int i = 0; i < 60; ++i) {
      std::vector<Detection> seen;
      if (i % period == 0) seen.push_back(Seen("book", 100, 200));
      tracks.Update(i * kFrame_s, seen);
    }
    tracks.Update(60 * kFrame_s, {Seen("book", 100, 200)});
    int filled = 0;
    for (int i = 61; i < 80; ++i)
      filled += static_cast<int>(tracks.Update(i * kFrame_s, {}).size());
    return filled;
  };
  EXPECT_GT(filled_after(2), filled_after(1));
}

TEST(BoxTracks, NeverFillsALoneFalsePositive) {
  BoxTracks tracks({}, kImage);
  const auto first = tracks.Update(0, {Seen("book", 100, 200)});
  ASSERT_EQ(first.size(), 1u);
  EXPECT_TRUE(tracks.Update(kFrame_s, {}).empty());
}

TEST(BoxTracks, KeepsTheBetterOfTwoBoxesOnOneObject) {
  BoxTracks tracks({}, kImage);
  Detection worse = Seen("book", 101, 200);
  worse.score = 0.5;
  const auto answer =
      tracks.Update(0, {worse, Seen("book", 100, 200), Seen("laptop", 100, 200)});
  ASSERT_EQ(answer.size(), 2u);
  EXPECT_EQ(answer[0].score, 0.9);
  EXPECT_EQ(answer[1].class_name, "laptop");
}

TEST(BoxTracks, OutvotesASingleConfusedClass) {
  BoxTracks tracks({}, kImage);
  for (int i = 0; i < 10; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  Detection confused = Seen("teddy bear", 100, 200);
  confused.kind = ClassKind::kUnstructured;
  const auto answer = tracks.Update(10 * kFrame_s, {confused});
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_EQ(answer[0].class_name, "book");
  EXPECT_EQ(answer[0].kind, ClassKind::kRegular);
}

TEST(BoxTracks, LetsSteadyEvidenceChangeTheClass) {
  BoxTracks tracks({}, kImage);
  for (int i = 0; i < 5; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  std::vector<Detection> answer;
  for (int i = 5; i < 100; ++i)
    answer = tracks.Update(i * kFrame_s, {Seen("laptop", 100, 200)});
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_EQ(answer[0].class_name, "laptop");
}

TEST(BoxTracks, DoesNotFillABoxThatLeftTheImage) {
  BoxTracks tracks({}, kImage);
  int i = 0;
  for (; i < 12; ++i) {
    Detection d = Seen("book", 430 + 15 * i, 200);
    d.box_px = Intersection(d.box_px, kImage);
    tracks.Update(i * kFrame_s, {d});
  }
  for (; i < 25; ++i)
    for (const Detection& d : tracks.Update(i * kFrame_s, {}))
      EXPECT_TRUE(kImage.Contains(d.box_px.min) && kImage.Contains(d.box_px.max));
  EXPECT_TRUE(tracks.Update(25 * kFrame_s, {}).empty());
}

TEST(BoxTracks, ForgetsAllTracksOverALongPause) {
  BoxTracks tracks({}, kImage);
  for (int i = 0; i < 10; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  EXPECT_TRUE(tracks.Update(5.0, {}).empty());
}

TEST(BoxTracks, RefusesATimestampThatDoesNotIncrease) {
  BoxTracks tracks({}, kImage);
  tracks.Update(1.0, {});
  EXPECT_THROW(tracks.Update(1.0, {}), std::invalid_argument);
  EXPECT_THROW(tracks.Carry(1.0), std::invalid_argument);
}

/// A detector that is asked in every Nth frame.
struct SeldomAsked {
  int every;
  BoxTracks tracks{{}, kImage};
  int frame = 0;

  bool Asked() const { return frame % every == 0; }
  /// The next frame, in which the detector would give these boxes.
  std::vector<Detection> Next(const std::vector<Detection>& seen) {
    const double t = frame * kFrame_s;
    const bool asked = Asked();
    ++frame;
    return asked ? tracks.Update(t, seen) : tracks.Carry(t);
  }
};

TEST(BoxTracks, CarriesBoxesToWhereTheyHaveMovedWhileTheDetectorIsNotAsked) {
  for (const int every : {2, 5, 10}) {
    SeldomAsked seldom{every};
    for (int i = 0; i < 10 * every; ++i) {
      const bool asked = seldom.Asked();
      const Detection book = Seen("book", 50 + 4 * i, 200);
      const auto answer = seldom.Next({book});
      ASSERT_EQ(answer.size(), 1u) << every << " " << i;
      EXPECT_EQ(answer[0].compensated, !asked);
      EXPECT_EQ(answer[0].class_name, "book");
      if (i >= 3 * every) {  // its speed is known
        EXPECT_GT(Iou(answer[0].box_px, book.box_px), 0.9) << every << " " << i;
      }
    }
  }
}

TEST(BoxTracks, TakesAFrameThatWasNotAskedForNoMiss) {
  // Twenty frames without an answer are more than a track outlives when it is missed in each.
  ASSERT_GT(20, BoxTracksConfig{}.max_coast_frames);
  SeldomAsked seldom{20};
  for (int i = 0; i < 61; ++i) ASSERT_EQ(seldom.Next({Seen("book", 100, 200)}).size(), 1u) << i;
  // It is one track, confirmed by its four hits: a miss is filled at once.
  const auto answer = seldom.tracks.Update(61 * kFrame_s, {});
  ASSERT_EQ(answer.size(), 1u);
  EXPECT_TRUE(answer[0].compensated);
}

TEST(BoxTracks, LearnsTheRateOfDetectionFromTheFramesThatWereAsked) {
  // Always found, or found every second time that it is asked.
  const auto filled_after = [](int period) {
    SeldomAsked seldom{3};
    for (int i = 0; i < 180; ++i) {
      std::vector<Detection> seen;
      if (i / 3 % period == 0) seen.push_back(Seen("book", 100, 200));
      seldom.Next(seen);
    }
    BoxTracks& tracks = seldom.tracks;
    tracks.Update(180 * kFrame_s, {Seen("book", 100, 200)});
    int filled = 0;
    for (int i = 181; i < 200; ++i)
      filled += static_cast<int>(tracks.Update(i * kFrame_s, {}).size());
    return filled;
  };
  EXPECT_GT(filled_after(2), filled_after(1));
}

TEST(BoxTracks, BelievesAMissThatComesAfterMoreFramesThanAreFilled) {
  SeldomAsked seldom{BoxTracksConfig{}.max_gap_frames + 1};
  for (int i = 0; i < 5 * seldom.every; ++i) {
    ASSERT_EQ(seldom.Next({Seen("book", 100, 200)}).size(), 1u);
  }
  for (int i = 0; i < seldom.every; ++i) EXPECT_TRUE(seldom.Next({}).empty()) << i;
  // Its track has not ended: when it is found again, a miss is filled at once.
  ASSERT_EQ(seldom.tracks.Update(54 * kFrame_s, {Seen("book", 100, 200)}).size(), 1u);
  EXPECT_EQ(seldom.tracks.Update(55 * kFrame_s, {}).size(), 1u);
}

TEST(BoxTracks, CarriesNoBoxForMoreThanASecond) {
  SeldomAsked seldom{60};
  for (int i = 0; i < 240; ++i) {
    const bool within_a_second = i % 60 <= 30;
    EXPECT_EQ(seldom.Next({Seen("book", 100, 200)}).size(), within_a_second ? 1u : 0u) << i;
  }
}

TEST(BoxTracks, CarriesOneBoxForTwoTracksOfOneObject) {
  SeldomAsked seldom{5};
  for (int i = 0; i < 15; ++i) {
    // The second moves onto the first: at frame 14 they are 4 px apart.
    const auto answer =
        seldom.Next({Seen("book", 100, 200), Seen("book", 100 + 60 - 4 * i, 200)});
    if (i < 12) {
      EXPECT_EQ(answer.size(), 2u) << i;
    }
    if (i == 14) {
      EXPECT_EQ(answer.size(), 1u);
    }
  }
}

TEST(BoxTracks, CarriesNothingWhenDisabled) {
  BoxTracks tracks({.enabled = false}, kImage);
  for (int i = 0; i < 10; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  EXPECT_TRUE(tracks.Carry(10 * kFrame_s).empty());
}

TEST(BoxTracks, PassesEverythingThroughWhenDisabled) {
  BoxTracks tracks({.enabled = false}, kImage);
  for (int i = 0; i < 10; ++i) tracks.Update(i * kFrame_s, {Seen("book", 100, 200)});
  EXPECT_TRUE(tracks.Update(10 * kFrame_s, {}).empty());
}

}  // namespace
}  // namespace slam
