#include "slam/run/frame_record.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace slam {
namespace {

nlohmann::ordered_json RecordOf(const PlaneMatch& match) {
  Frame frame;
  frame.planes.resize(1);
  frame.planes[0].pi_c.n = Eigen::Vector3d::UnitZ();
  frame.plane_matches = {match};
  return FramePlanesRecord(frame, true)["planes"][0];
}

TEST(FramePlanesRecord, TellsWhatDidNotHoldThePoseInTheWorldsAxes) {
  // Rolled by a quarter turn: what is to the right of the camera is up in the world.
  Frame frame;
  frame.T_cw = {ExpSo3({0, 0, -M_PI / 2}), {1, 2, 3}};
  frame.degenerate = {{false, Eigen::Vector3d::UnitX()}, {true, Eigen::Vector3d::UnitZ()}};
  const auto record = FramePlanesRecord(frame, true, "planes");
  EXPECT_EQ(record["state"], "planes");
  const auto& axes = record["degenerate"];
  ASSERT_EQ(axes.size(), 2u);
  ASSERT_EQ(axes[0].size(), 1u);
  ASSERT_EQ(axes[1].size(), 1u);
  const auto expect_axis = [](const nlohmann::ordered_json& said,
                              const Eigen::Vector3d& axis_w) {
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(said[static_cast<std::size_t>(i)].get<double>(), axis_w[i], 1e-12);
  };
  expect_axis(axes[0].at("along"), Eigen::Vector3d::UnitY());
  expect_axis(axes[1].at("about"), Eigen::Vector3d::UnitZ());
  // A frame without a pose has none to be held, and one that everything holds has nothing to tell.
  EXPECT_FALSE(FramePlanesRecord(frame, false).contains("degenerate"));
  frame.degenerate.clear();
  EXPECT_FALSE(FramePlanesRecord(frame, true).contains("degenerate"));
}

// The format's table of `decision` and `by`.
TEST(FramePlanesRecord, NamesWhatDecidedAndGivesTheLandmarkWhereThereIsOne) {
  const auto said = [](PlaneDecision decision, MatchReason reason) {
    const auto plane = RecordOf({decision, 7, reason});
    return std::array{plane["decision"].dump(), plane["by"].dump(), plane["map_plane"].dump()};
  };
  using Said = std::array<std::string, 3>;
  for (const auto& [reason, name] :
       std::map<MatchReason, const char*>{{MatchReason::kParameters, "\"parameters\""},
                                          {MatchReason::kOverlap, "\"overlap\""},
                                          {MatchReason::kClass, "\"class\""},
                                          {MatchReason::kBox, "\"iou\""},
                                          {MatchReason::kRankTest, "\"ranksum\""}}) {
    EXPECT_EQ(said(PlaneDecision::kMatched, reason), (Said{"\"matched\"", name, "7"}));
  }
  EXPECT_EQ(said(PlaneDecision::kUnmatched, MatchReason::kAmbiguous),
            (Said{"\"none\"", "\"ambiguous\"", "null"}));
  EXPECT_EQ(said(PlaneDecision::kUnmatched, MatchReason::kNothing),
            (Said{"\"none\"", "null", "null"}));
  // On trial it shows no landmark yet, whatever it was matched by.
  for (const MatchReason reason : {MatchReason::kNothing, MatchReason::kOverlap})
    EXPECT_EQ(said(PlaneDecision::kTrial, reason), (Said{"\"none\"", "\"candidate\"", "null"}));
  EXPECT_EQ(said(PlaneDecision::kNew, MatchReason::kOverlap),
            (Said{"\"new\"", "\"unmatched\"", "7"}));
  EXPECT_EQ(said(PlaneDecision::kNew, MatchReason::kSplit),
            (Said{"\"new\"", "\"split\"", "7"}));
}

TEST(FramePlanesRecord, NamesEachFaultOfAPlaneByAWordOfItsOwn) {
  EXPECT_STREQ(BadReasonText(BadReason::kFar), "far");
  EXPECT_STREQ(BadReasonText(BadReason::kInliers), "inliers");
  EXPECT_STREQ(BadReasonText(BadReason::kBorder), "border");
  EXPECT_STREQ(BadReasonText(BadReason::kStructure), "structure");
  EXPECT_STREQ(BadReasonText(BadReason::kUnstructured), "unstructured");
}

TEST(FramePlanesRecord, RefusesADecisionWithoutAMapPlane) {
  for (const PlaneDecision decision :
       {PlaneDecision::kMatched, PlaneDecision::kTrial, PlaneDecision::kNew})
    EXPECT_THROW(RecordOf({decision, kNone, MatchReason::kParameters}), std::invalid_argument);
}

}  // namespace
}  // namespace slam
