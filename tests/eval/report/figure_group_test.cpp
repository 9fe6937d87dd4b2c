#include "eval/report/figure_group.h"

#include <gtest/gtest.h>

namespace eval {
namespace {

TEST(FigureGroup, HasAnF1OfNothingWhereOneOfItsPartsIsNotDefined) {
  nlohmann::ordered_json reasons = nlohmann::ordered_json::object();
  FigureGroup group("association", reasons);
  group.PutShares("pair", {0.0, 0.0, 0.0}, "nothing was found", "");
  EXPECT_TRUE(group.json()["pair"]["precision"].is_null());
  EXPECT_EQ(group.json()["pair"]["recall"], 0.0);
  EXPECT_EQ(group.json()["pair"]["f1"], 0.0);
  EXPECT_EQ(reasons.size(), 1u);
  group.PutShares("pair", {0.0, 0.0, 0.0}, "nothing was found", "nothing is there");
  EXPECT_TRUE(group.json()["pair"]["f1"].is_null());
  EXPECT_EQ(reasons["association/pair/f1"], "nothing was found");
}

}  // namespace
}  // namespace eval
