#include "eval/planes/clear_score.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

// The pair of the frame before is preferred; after a frame without a match there is none, and the
// best one counts.
TEST(ClearScore, PrefersThePairOfTheFrameBeforeAlone) {
  const auto frame = [](std::vector<int> predicted, std::vector<double> similarity) {
    TrackingFrame made;
    made.truth_ids = {1};
    made.predicted_ids = std::move(predicted);
    made.similarity.resize(1, static_cast<Eigen::Index>(similarity.size()));
    for (std::size_t j = 0; j < similarity.size(); ++j)
      made.similarity(0, static_cast<Eigen::Index>(j)) = similarity[j];
    return made;
  };
  const TrackingFrame first = frame({7}, {0.9}), nothing = frame({9}, {0.1}),
                      both = frame({7, 8}, {0.6, 0.7});
  const ClearScore kept = ScoreClear({first, both});
  EXPECT_EQ(kept.id_switches, 0);
  EXPECT_NEAR(kept.similarity_sum, 0.9 + 0.6, 1e-12);
  const ClearScore interrupted = ScoreClear({first, nothing, both});
  EXPECT_EQ(interrupted.id_switches, 1);
  EXPECT_NEAR(interrupted.similarity_sum, 0.9 + 0.7, 1e-12);
}

}  // namespace
}  // namespace eval
