#include "slam/input/repeated_images.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/stream_run.h"

namespace slam {
namespace {

// Which frames come twice: one, every tenth, every other.
TEST(FaultStreamF3, AnImageThatCameTwiceIsTheSamePlaceAndTeachesNothing) {
  const auto clean = CleanStream(30);
  for (const int every : {29, 10, 2}) {
    SCOPED_TRACE(testing::Message() << "each " << every << "th");
    std::vector<RecordedFrame> stream;
    std::vector<std::size_t> repeats;  // their places in the stream
    for (std::size_t i = 0; i < clean.size(); ++i) {
      stream.push_back(clean[i]);
      if ((static_cast<int>(i) + 1) % every != 0) continue;
      stream.push_back(clean[i]);
      stream.back().timestamp_s += 0.01;
      repeats.push_back(stream.size() - 1);
    }
    RunOptions options;
    const Ran once = RunStream(clean, options), ran = RunStream(stream, options);
    ASSERT_EQ(ran.poses_wc.size(), stream.size());
    for (const std::size_t at : repeats) {
      const Pose T = Inverse(ran.poses_wc[at - 1].second) * ran.poses_wc[at].second;
      EXPECT_LT(T.t.norm(), 1e-6);
      EXPECT_LT(LogSo3(T.R).norm(), 1e-6);
      EXPECT_EQ(ran.states[at], "tracking");
      EXPECT_THAT(ran.planes[at], testing::Not(testing::HasSubstr("\"new\"")));
      EXPECT_EQ(Measured(ran.planes[at]), Measured(ran.planes[at - 1]));
    }
    ExpectNoWrongPose(ran);
    EXPECT_EQ(ran.outcome.map_planes, once.outcome.map_planes);
    ASSERT_EQ(ran.outcome.warnings.size(), 1u);
    EXPECT_THAT(ran.outcome.warnings[0],
                testing::HasSubstr(std::to_string(repeats.size()) + " frame"));
  }
}

// Null would say that nothing of the map came into question.
TEST(RepeatedFrame, SaysByWhatItIsMatchedWithWhatWasNewThen) {
  auto stream = CleanStream(12);
  const Ran once = RunStream(stream, {});
  std::size_t at = 0;
  while (at < stream.size() && once.planes[at].find("\"new\"") == std::string::npos) ++at;
  ASSERT_LT(at, stream.size());
  stream.resize(at + 1);
  stream.push_back(stream.back());
  stream.back().timestamp_s += 0.01;
  const Ran ran = RunStream(stream, {});
  int matched = 0;
  const auto repeat = nlohmann::json::parse(ran.planes.back());
  for (const auto& plane : repeat.at("planes")) {
    if (plane.at("decision") != "matched") continue;
    EXPECT_TRUE(plane.at("by").is_string()) << plane;
    ++matched;
  }
  EXPECT_GT(matched, 0);
}

/// Two frames, the last of which comes so many times more: short of a landmark's trial, so that
/// a third observation makes new ones.
Ran RunStuck(int repeats) {
  auto stream = CleanStream(2);
  const RecordedFrame last = stream.back();
  for (int k = 1; k <= repeats; ++k) {
    stream.push_back(last);
    stream.back().timestamp_s += k / 30.0;
  }
  return RunStream(stream, {});
}

TEST(FaultStreamF3, ALastImageThatComesTwiceAgainLeavesTheMapAsItWas) {
  const Ran once = RunStuck(0), ran = RunStuck(kMaxRepeats);
  EXPECT_EQ(ran.outcome.tracked, 2 + kMaxRepeats);
  EXPECT_EQ(ran.map, once.map);
  EXPECT_EQ(ran.outcome.map_points, once.outcome.map_points);
  EXPECT_EQ(ran.outcome.keyframes, once.outcome.keyframes);
}

TEST(RepeatedFrame, RefusesNoPairOfPlanesOnceMore) {
  const Ran once = RunStuck(0), ran = RunStuck(kMaxRepeats);
  long refused = 0;
  for (const auto& [cue, pairs] : once.run.at("refused_pairs").items())
    refused += pairs.get<long>();
  ASSERT_GT(refused, 0);
  EXPECT_EQ(ran.run.at("refused_pairs"), once.run.at("refused_pairs"));
}

TEST(RepeatedFrame, OfAWorldThatStandsStillBeforeAPerfectCameraIsLearnedFrom) {
  const Ran ran = RunStuck(30);
  EXPECT_EQ(ran.outcome.tracked, 32);
  EXPECT_GT(ran.outcome.map_planes, 0);
  const Pose T = Inverse(ran.poses_wc[1].second) * ran.poses_wc.back().second;
  EXPECT_LT(T.t.norm(), 1e-3);
  EXPECT_LT(LogSo3(T.R).norm(), 1e-3);
}

}  // namespace
}  // namespace slam
