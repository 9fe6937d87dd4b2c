#include "slam/segment/tournament.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace slam {
namespace {

TEST(Tournament, IsWonByTheFirstOfTheLeastWhateverChanges) {
  for (const std::size_t count : {1u, 2u, 7u, 8u, 33u}) {
    std::vector<double> costs;
    for (std::size_t k = 0; k < count; ++k) costs.push_back(static_cast<double>(k * 7 % 5));
    Tournament tournament;
    tournament.Begin(costs);
    for (std::size_t turn = 0; turn < 200; ++turn) {
      const auto least = std::min_element(costs.begin(), costs.end());
      EXPECT_EQ(tournament.least(), *least);
      EXPECT_EQ(tournament.winner(), least - costs.begin());
      const std::size_t k =
          turn % 3 == 0 ? static_cast<std::size_t>(least - costs.begin()) : turn * 11 % count;
      costs[k] = turn % 4 == 0 ? Tournament::kOut : static_cast<double>(turn * 13 % 6) - 1.0;
      tournament.Change(static_cast<int>(k), costs[k]);
    }
  }
}

TEST(Tournament, EndsWhenAllAreOut) {
  Tournament tournament;
  tournament.Begin({});
  EXPECT_EQ(tournament.least(), Tournament::kOut);
  tournament.Begin({3.0, 2.0});
  tournament.Change(1, Tournament::kOut);
  EXPECT_EQ(tournament.winner(), 0);
  tournament.Change(0, Tournament::kOut);
  EXPECT_EQ(tournament.least(), Tournament::kOut);
}

}  // namespace
}  // namespace slam
