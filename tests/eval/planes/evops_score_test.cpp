#include "eval/planes/evops_score.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

/// One true plane of 100 pixels, of which the machine has two pieces.
EvopsScore OfTwoPieces(int large_px, int small_px) {
  return ScoreEvops(OverlapOf(
      LabelPairs{{{1, 1}, large_px}, {{1, 2}, small_px}, {{1, 0}, 100 - large_px - small_px}}));
}

TEST(EvopsScore, TakesAPieceForAPartnerFromAFifthOn) {
  EXPECT_EQ(OfTwoPieces(70, 20).over_ratio, 1.0);
  EXPECT_EQ(OfTwoPieces(70, 19).over_ratio, 0.0);
  // A plane in pieces is not missed, and the pieces are no noise; a single piece is both.
  EXPECT_EQ(OfTwoPieces(70, 20).missed_ratio, 0.0);
  EXPECT_EQ(OfTwoPieces(70, 20).noise_ratio, 0.0);
  EXPECT_EQ(OfTwoPieces(70, 19).missed_ratio, 1.0);
  EXPECT_EQ(OfTwoPieces(70, 19).noise_ratio, 1.0);
}

TEST(EvopsScore, TakesAPieceForAMatchFromThreeQuartersOn) {
  const EvopsScore match = OfTwoPieces(75, 20), none = OfTwoPieces(74, 20);
  EXPECT_EQ(match.recall, 1.0);
  EXPECT_EQ(match.precision, 0.5);
  EXPECT_EQ(match.mean_iou, 0.75);
  EXPECT_DOUBLE_EQ(match.mean_dice, 2 * 75 / 175.0);
  EXPECT_EQ(none.f1, 0.0);
  EXPECT_EQ(none.mean_iou, 0.0);
}

TEST(EvopsScore, OfNothingIsNothing) {
  EXPECT_EQ(ScoreEvops({}).f1, 0.0);
  EXPECT_EQ(ScoreEvops({}).missed_ratio, 0.0);
}

}  // namespace
}  // namespace eval
