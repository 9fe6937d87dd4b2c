#include "eval/report/figure_group.h"

#include <gtest/gtest.h>

#include <utility>

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

TEST(ClaimScoreAsJson, TellsEachKindOfErrorUnderItsOwnName) {
  ClaimScore claims;
  claims.position = {1.0, 0.9, 0.95, 0.02};
  claims.rotation = {4.0, 3.5, 0.60, 0.39};
  claims.pose = {2.5, 2.2, 0.75, 0.21};
  const nlohmann::ordered_json json = ToJson(claims);
  for (const auto& [name, nees] : {std::pair("position_nees", claims.position),
                                   {"rotation_nees", claims.rotation},
                                   {"pose_nees", claims.pose}}) {
    EXPECT_EQ(json.at(name).at("mean"), nees.mean) << name;
    EXPECT_EQ(json.at(name).at("median"), nees.median) << name;
    EXPECT_EQ(json.at(name).at("inside"), nees.inside) << name;
    EXPECT_EQ(json.at(name).at("above"), nees.above) << name;
  }
}

}  // namespace
}  // namespace eval
