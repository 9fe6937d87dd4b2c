// Which class a track gives its boxes, and how sure it is of them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "slam/detect/box_tracks.h"

namespace slam {
namespace {

const Box kPicture{{0, 0}, {639, 479}};
constexpr double kEvery_s = 1.0 / 30;

/// One thing that stays where it is, called this and that.
struct OneThing {
  BoxTracks tracks;
  int frame = 0;

  explicit OneThing(const BoxTracksConfig& config) : tracks(config, kPicture) {}
  Detection See(const std::string& name, double score) {
    const Detection seen{
        .class_name = name,
        .kind = name == "book" ? ClassKind::kRegular : ClassKind::kUnstructured,
        .score = score,
        .box_px = {{100, 200}, {180, 260}}};
    const auto answer = tracks.Update(kEvery_s * frame++, {seen});
    EXPECT_EQ(answer.size(), 1u);
    return answer.at(0);
  }
};

BoxTracksConfig Remembering(double memory, double ratio, int min_hits = 1) {
  BoxTracksConfig config;
  config.class_memory = memory, config.min_class_ratio = ratio, config.min_hits = min_hits;
  return config;
}

TEST(BoxTracksClass, IsTheOneWithSoManyTimesTheScoresOfTheDetectors) {
  // By hand: so many books of 0.8 against one, two ... cats of 0.5, nothing forgotten.
  for (const double ratio : {1.2, 2.0, 3.0}) {
    OneThing thing(Remembering(1.0, ratio));
    for (int k = 0; k < 4; ++k) thing.See("book", 0.8);
    for (int cats = 1; cats <= 6; ++cats) {
      const bool outvoted = 4 * 0.8 > ratio * cats * 0.5;
      const Detection answer = thing.See("cat", 0.5);
      EXPECT_EQ(answer.class_name, outvoted ? "book" : "cat") << ratio << " " << cats;
      EXPECT_EQ(answer.kind, outvoted ? ClassKind::kRegular : ClassKind::kUnstructured);
    }
  }
}

TEST(BoxTracksClass, ForgetsTheShareThatItIsToldToFromFrameToFrame) {
  for (const double memory : {1.0, 0.7, 0.4}) {
    OneThing thing(Remembering(memory, 1.0));
    double books = 0.0;
    for (int k = 0; k < 5; ++k) books = memory * books + 0.6, thing.See("book", 0.6);
    double cats = 0.0;
    for (int k = 0; k < 5; ++k) {
      books *= memory, cats = memory * cats + 0.7;
      EXPECT_EQ(thing.See("cat", 0.7).class_name, books > cats ? "book" : "cat") << memory << k;
    }
  }
}

TEST(BoxTracksClass, IsTheDetectorsOwnUntilTheTrackIsConfirmed) {
  for (const int min_hits : {2, 3, 5}) {
    OneThing thing(Remembering(1.0, 1.0, min_hits));
    thing.See("book", 0.9);
    for (int hits = 2; hits <= 6; ++hits) {
      EXPECT_EQ(thing.See("cat", 0.01).class_name, hits < min_hits ? "cat" : "book")
          << min_hits;
    }
  }
}

// A box that is carried is there as likely as things stay in view.
TEST(BoxTracksScore, OfACarriedBoxFallsByTheShareThatStaysInView) {
  BoxTracksConfig config;
  config.survival = 0.9, config.min_existence = 0.0;
  OneThing thing(config);
  for (int k = 0; k < 5; ++k) thing.See("book", 0.5 + 0.1 * k);
  for (int k = 1; k <= 6; ++k) {
    const auto answer = thing.tracks.Carry(kEvery_s * thing.frame++);
    ASSERT_EQ(answer.size(), 1u);
    EXPECT_NEAR(answer[0].score, 0.9 * std::pow(config.survival, k), 1e-12);
    EXPECT_EQ(answer[0].kind, ClassKind::kRegular);
  }
  EXPECT_NEAR(thing.See("book", 0.6).score, 0.6, 1e-12) << "seen again it is there";
  EXPECT_NEAR(thing.tracks.Carry(kEvery_s * thing.frame++).at(0).score, 0.9 * 0.6, 1e-12);
}

}  // namespace
}  // namespace slam
