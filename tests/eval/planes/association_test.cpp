#include "eval/planes/association.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

namespace eval {
namespace {

constexpr int kTrueDesk = 1, kTrueBook = 2;

bool ByAll(const AssociationRecord& a, const AssociationRecord& b) {
  return std::tie(a.frame, a.truth, a.map_plane, a.pixels) <
         std::tie(b.frame, b.truth, b.map_plane, b.pixels);
}

TEST(JudgeDecisions, AMapPlaneThatTwoSurfacesMakeIsOfTheOneWithMostPixels) {
  // Desk and book are both put on the new map plane 7, then the desk alone.
  std::vector<AssociationRecord> records = {{0, kTrueDesk, 7, 300},
                                            {0, kTrueBook, 7, 900},
                                            {0, kTrueDesk, 7, 400},
                                            {1, kTrueDesk, 7, 5000}};
  std::sort(records.begin(), records.end(), ByAll);
  do {
    if (records.back().frame != 1) continue;
    EXPECT_EQ(OwnersOf(records).at(7), kTrueBook);
    const DecisionCounts counts = ScoreAssociation(records).decision;
    EXPECT_EQ(counts.tn, 1);
    EXPECT_EQ(counts.fp, 3);
    EXPECT_EQ(counts.tp + counts.fn + counts.spurious, 0);
  } while (std::next_permutation(records.begin(), records.end(), ByAll));
}

TEST(JudgeDecisions, PiecesOfTheSurfaceThatMakesAMapPlaneAreSummed) {
  const std::vector<AssociationRecord> records = {
      {0, kTrueBook, 7, 600}, {0, kTrueDesk, 7, 400}, {0, kTrueDesk, 7, 400}};
  EXPECT_EQ(OwnersOf(records).at(7), kTrueDesk);
}

TEST(JudgeDecisions, EqualSurfacesMakeAMapPlaneOfTheLowerIdAndNoiseGivesWay) {
  EXPECT_EQ(OwnersOf({{0, kTrueBook, 7, 50}, {0, kTrueDesk, 7, 50}}).at(7), kTrueDesk);
  EXPECT_EQ(OwnersOf({{0, 0, 7, 50}, {0, kTrueBook, 7, 50}}).at(7), kTrueBook);
  EXPECT_EQ(OwnersOf({{0, 0, 7, 51}, {0, kTrueBook, 7, 50}}).at(7), 0);
}

TEST(JudgeDecisions, NoiseThatMakesAMapPlaneIsSpuriousThereAndAgain) {
  const auto judged = JudgeDecisions({{0, 0, 7, 50}, {1, 0, 7, 50}, {2, kTrueDesk, 7, 50}});
  EXPECT_EQ(judged[0].outcome, DecisionOutcome::kSpurious);
  EXPECT_EQ(judged[1].outcome, DecisionOutcome::kNoiseAgain);
  EXPECT_EQ(judged[2].outcome, DecisionOutcome::kWrong);
  EXPECT_FALSE(judged[2].truth_had_owner);
}

}  // namespace
}  // namespace eval
