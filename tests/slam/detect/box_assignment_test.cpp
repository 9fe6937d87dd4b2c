#include "slam/detect/box_assignment.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "slam/base/random.h"

namespace slam {
namespace {

TEST(BoxAssignment, MaximisesTheSumAndNotEachRowByItself) {
  // Greedy takes 0.9 and is left with 0.1; the best sum is 0.8 + 0.7.
  EXPECT_EQ(AssignForLargestGain({{0.9, 0.8}, {0.7, 0.1}}), (std::vector<int>{1, 0}));
}

TEST(BoxAssignment, AgreesWithTryingEveryPermutation) {
  for (std::uint64_t trial = 0; trial < 300; ++trial) {
    Random random{5, trial};
    const int rows = 1 + random.Below(5), columns = 1 + random.Below(5);
    std::vector<std::vector<double>> gain(static_cast<std::size_t>(rows));
    for (auto& row : gain)
      for (int c = 0; c < columns; ++c) row.push_back(random.Uniform() - 0.3);
    // Reference: each row takes a free column or none, all ways.
    std::vector<bool> taken(static_cast<std::size_t>(columns), false);
    const std::function<double(std::size_t)> best = [&](std::size_t r) {
      if (r == gain.size()) return 0.0;
      double sum = best(r + 1);
      for (std::size_t c = 0; c < taken.size(); ++c) {
        if (taken[c]) continue;
        taken[c] = true;
        sum = std::max(sum, gain[r][c] + best(r + 1));
        taken[c] = false;
      }
      return sum;
    };
    double sum = 0;
    const std::vector<int> answer = AssignForLargestGain(gain);
    for (std::size_t r = 0; r < gain.size(); ++r)
      if (answer[r] >= 0) sum += gain[r][static_cast<std::size_t>(answer[r])];
    EXPECT_NEAR(sum, best(0), 1e-12);
  }
}

TEST(BoxAssignment, LeavesRowsWithoutGainUnassigned) {
  EXPECT_EQ(AssignForLargestGain({{0.0, 0.0}, {0.0, 0.3}}), (std::vector<int>{-1, 1}));
  EXPECT_EQ(AssignForLargestGain({{}, {}}), (std::vector<int>{-1, -1}));
  EXPECT_TRUE(AssignForLargestGain({}).empty());
}

}  // namespace
}  // namespace slam
