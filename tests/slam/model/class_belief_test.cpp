#include "slam/model/class_belief.h"

#include <gtest/gtest.h>

#include <cmath>

namespace slam {
namespace {

// By hand, from the rates that class_likelihood.cpp states: none 0.6 a priori, an object missed
// in 0.35 of its frames, a false class in 0.06.
TEST(ClassLikelihood, IsThePriorsWhenNothingIsKnown) {
  EXPECT_NEAR(ClassLikelihood({}, ""), 0.94, 1e-12);
  EXPECT_NEAR(ClassLikelihood({}, "book"), 0.6 * 0.06 + 0.4 * 0.65, 1e-12);
  // Once it is seen as a book: posterior 0.036 : 0.26.
  const double book = 0.26 / 0.296;
  EXPECT_NEAR(ClassLikelihood({{"book", 1.0}}, ""), book * 0.35 + (1 - book) * 0.94, 1e-12);
}

// One particular other class is given in 0.03 of the frames.
TEST(ClassLikelihood, SharesThePriorOfObjectsAmongTheClassesInQuestion) {
  // None 0.6, book and cup 0.2 each; once seen as a cup: posterior 0.036 : 0.006 : 0.13.
  EXPECT_NEAR(ClassLikelihood({{"cup", 1.0}}, "book"),
              (0.036 * 0.06 + 0.006 * 0.65 + 0.13 * 0.03) / 0.172, 1e-12);
}

TEST(ClassLikelihood, KnowsNoMoreFromEvidenceBeyondTwentyFrames) {
  const double twenty = ClassLikelihood({{"book", 6.0}, {"", 14.0}}, "book");
  EXPECT_NEAR(ClassLikelihood({{"book", 60.0}, {"", 140.0}}, "book"), twenty, 1e-12);
  EXPECT_GT(std::abs(ClassLikelihood({{"book", 3.0}, {"", 7.0}}, "book") - twenty), 1e-3);
}

TEST(SameClassOdds, AreOneWithoutEvidenceOfBothAndSayWhatTheyShare) {
  EXPECT_NEAR(SameClassOdds({}, {{"book", 3.0}}), 1.0, 1e-12);
  const double book = 0.26 / 0.296, none = 0.036 / 0.296;
  EXPECT_NEAR(SameClassOdds({{"book", 1.0}}, {{"book", 1.0}}),
              none * none / 0.6 + book * book / 0.4, 1e-12);
  EXPECT_LT(SameClassOdds({{"book", 3.0}}, {{"cup", 3.0}}), 0.1);
}

TEST(ClassBelief, IsNotTheFirstLabel) {
  MapPlane m;
  UpdateClassBelief(m, "keyboard", 0.9);
  for (int i = 0; i < 6; ++i) UpdateClassBelief(m, "book", 0.9);
  EXPECT_EQ(m.class_name, "book");
}

TEST(ClassBelief, SurvivesMissesButNotAMajorityOfThem) {
  MapPlane m;
  for (int i = 0; i < 4; ++i) UpdateClassBelief(m, "book", 0.9);
  for (int i = 0; i < 4; ++i) UpdateClassBelief(m, "", 1);
  EXPECT_EQ(m.class_name, "book");
  MapPlane desk;
  for (int i = 0; i < 12; ++i) UpdateClassBelief(desk, "", 1);
  UpdateClassBelief(desk, "book", 0.9);
  EXPECT_EQ(desk.class_name, "");
}

TEST(ClassBelief, IsLostSoonerWhereDetectionsContradictEachOther) {
  // By hand: none 0.6 * 0.06^2 * 0.94 = 0.00203, either object 0.2 * 0.65 * 0.03 * 0.35 = 0.00137.
  MapPlane desk;
  for (const char* name : {"book", "cup", ""}) UpdateClassBelief(desk, name, 1.0);
  EXPECT_EQ(desk.class_name, "");
  // Two alike and a miss: 0.4 * 0.65^2 * 0.35 = 0.059.
  MapPlane book;
  for (const char* name : {"book", "book", ""}) UpdateClassBelief(book, name, 1.0);
  EXPECT_EQ(book.class_name, "book");
}

TEST(ClassBelief, CountsADetectionByItsScoreAndAMissAsAFullFrame) {
  MapPlane plane;
  for (int i = 0; i < 2; ++i) {
    UpdateClassBelief(plane, "", 0.3);
    UpdateClassBelief(plane, "book", 0.7);
    UpdateClassBelief(plane, "cup", 0.01);
  }
  EXPECT_DOUBLE_EQ(plane.class_belief.at(""), 2.0);
  EXPECT_DOUBLE_EQ(plane.class_belief.at("book"), 1.4);
  EXPECT_DOUBLE_EQ(plane.class_belief.at("cup"), 0.2);  // what was reported is some evidence
}

}  // namespace
}  // namespace slam
