#include "slam/segment/clusters/min_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace slam {
namespace {

TEST(MinTree, HasTheFirstOfTheSmallestCostsWhateverChanges) {
  for (const std::size_t count : {1u, 2u, 7u, 8u, 33u}) {
    std::vector<double> costs;
    for (std::size_t k = 0; k < count; ++k) costs.push_back(static_cast<double>(k * 7 % 5));
    MinTree tree;
    tree.Begin(costs);
    for (std::size_t turn = 0; turn < 200; ++turn) {
      const auto smallest = std::min_element(costs.begin(), costs.end());
      EXPECT_EQ(tree.empty(), *smallest == MinTree::kNone);
      if (!tree.empty()) {
        EXPECT_EQ(tree.first(), smallest - costs.begin());
      }
      const std::size_t k = turn % 3 == 0 ? static_cast<std::size_t>(smallest - costs.begin())
                                          : turn * 11 % count;
      costs[k] = turn % 4 == 0 ? MinTree::kNone : static_cast<double>(turn * 13 % 6) - 1.0;
      tree.Change(static_cast<int>(k), costs[k]);
    }
  }
}

TEST(MinTree, HasNoneWhenNoneTakesPart) {
  MinTree tree;
  tree.Begin({});
  EXPECT_TRUE(tree.empty());
  tree.Begin({3.0, 2.0});
  tree.Change(1, MinTree::kNone);
  EXPECT_EQ(tree.first(), 0);
  tree.Change(0, MinTree::kNone);
  EXPECT_TRUE(tree.empty());
}

}  // namespace
}  // namespace slam
