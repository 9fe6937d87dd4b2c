#include "eval/trajectory/pairs.h"

#include <gmock/gmock.h>

namespace eval {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(PairsByTime, InAChainBeginWhereTheOneBeforeEnds) {
  EXPECT_THAT(PairsByTime({0, 1, 2, 3, 4}, 1.0, 0.1, PairMode::kConsecutive),
              ElementsAre(Pair(0, 1), Pair(1, 2), Pair(2, 3), Pair(3, 4)));
  EXPECT_THAT(PairsByTime({0, 0.5, 1, 1.5, 2, 2.5}, 1.0, 0.1, PairMode::kConsecutive),
              ElementsAre(Pair(0, 2), Pair(2, 4)));
  EXPECT_THAT(PairsByTime({0, 0.5, 1, 1.5}, 1.0, 0.1, PairMode::kAll),
              ElementsAre(Pair(0, 2), Pair(1, 3)));
}

TEST(PairsByTime, AreNotClosedByAGapAndGoOnAfterIt) {
  EXPECT_THAT(PairsByTime({0, 1, 5, 6, 7}, 1.0, 0.1, PairMode::kConsecutive),
              ElementsAre(Pair(0, 1), Pair(2, 3), Pair(3, 4)));
}

}  // namespace
}  // namespace eval
