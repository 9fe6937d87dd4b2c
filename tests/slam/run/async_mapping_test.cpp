#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <future>
#include <stdexcept>

#include "tests/support/stream_run.h"

// Mapping beside tracking. Nothing here depends on how fast the two threads are.
namespace slam {
namespace {

RunOptions Options(bool async) {
  RunOptions options;
  options.variant = Variant::kPoints;
  options.config.async_mapping = async;
  return options;
}

/// Root mean square distance from the true centres.
double Rmse(const Ran& ran) {
  double sum = 0;
  for (const auto& [s, T_wc] : ran.poses_wc) sum += (T_wc.t - TruePoseAt(s).t).squaredNorm();
  return std::sqrt(sum / static_cast<double>(ran.poses_wc.size()));
}

TEST(AsyncMapping, TracksEveryFrameAboutAsWellAsMappingBetweenFrames) {
  const Ran sync = RunStream(Clean(), Options(false)),
            async = RunStream(Clean(), Options(true));
  EXPECT_EQ(async.outcome.tracked, kFrames);
  EXPECT_GE(async.outcome.keyframes, 2);
  // Noise of the stream alone: a pixel is 8 mm here.
  EXPECT_LT(Rmse(async), 1.5 * Rmse(sync) + 1e-3);
}

/// Points seen by one keyframe alone are culled, and duplicates fused, whoever does it.
TEST(AsyncMapping, LeavesAMapLikeThatOfMappingBetweenFrames) {
  const RunOutcome sync = RunStream(Clean(), Options(false)).outcome,
                   async = RunStream(Clean(), Options(true)).outcome;
  EXPECT_LE(async.keyframes, 4);  // so few can wait: none is dropped, however slow mapping is
  EXPECT_NEAR(async.map_points, sync.map_points, 0.1 * sync.map_points);
}

TEST(AsyncMapping, CarriesWhatMappingThrowsToTheCaller) {
  for (const bool async : {false, true}) {
    RunOptions options = Options(async);
    options.hooks.before_mapping = [](int keyframe) {
      if (keyframe == 1) throw std::runtime_error("mapping failed");
    };
    EXPECT_THROW(RunStream(Clean(), options), std::runtime_error);
  }
}

TEST(AsyncMapping, WritesAWholeRunWhenItIsStoppedInTheMiddle) {
  RunOptions options = Options(true);
  int done = 0;
  options.progress = [&](const char*, int frames, int) { done = frames; };
  options.stop = [&] { return done >= 23; };
  const Ran ran = RunStream(Clean(), options);
  EXPECT_TRUE(ran.outcome.stopped);
  EXPECT_EQ(ran.outcome.tracked, 24);  // the last was begun before it was asked
  EXPECT_EQ(ran.poses_wc.size(), 24u);
}

// Mapping does not end before the last frame is tracked. A tracking that waited for it would
// never get there.
TEST(AsyncMapping, TrackingGoesOnWhileMappingStands) {
  RunOptions options = Options(true);
  std::promise<void> tracked;
  const auto all = tracked.get_future().share();
  bool in_time = true;
  options.progress = [&](const char*, int done, int total) {
    if (done == total) tracked.set_value();
  };
  options.hooks.before_mapping = [&](int) {
    in_time = in_time && all.wait_for(std::chrono::minutes(1)) == std::future_status::ready;
  };
  const Ran ran = RunStream(Clean(), options);
  EXPECT_TRUE(in_time);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
}

TEST(AsyncMapping, TracksPlanesBesideMappingThatLooksForLoops) {
  RunOptions options = Options(true);
  options.variant = Variant::kFull;
  options.config.loop_closing.enabled = true;
  const Ran ran = RunStream(Clean(), options);
  EXPECT_EQ(ran.outcome.tracked, kFrames);
  EXPECT_GE(ran.outcome.map_planes, 1);
}

}  // namespace
}  // namespace slam
