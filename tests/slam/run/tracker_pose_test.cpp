#include <gmock/gmock.h>

#include "slam/model/map_queries.h"
#include "slam/run/tracker.h"
#include "tests/support/slam_matchers.h"
#include "tests/support/textured_world.h"

namespace slam {
namespace {

TEST(Tracker, GivesEachFrameItsPoseInTheMapAndTheStepFromTheFrameBefore) {
  const Camera camera = SmallCamera();
  const TexturedCorner corner;
  Tracker tracker(camera, {}, Variant::kFull, nullptr, 0, 1);
  Pose last_cw;
  int keyframes = 0;
  for (int i = 0; i < 40; ++i) {
    Frame frame = corner.See(camera, SwingingPose(4 * i), i);
    const TrackReport report =
        tracker.TrackFrame(frame, cv::Mat3b(camera.height, camera.width, cv::Vec3b(0, 0, 0)));
    ASSERT_TRUE(report.tracked) << "frame " << i;
    ASSERT_EQ(frame.T_lc.has_value(), i > 0);
    // What mapping moves a keyframe by afterwards is not in it.
    if (i > 0) {
      EXPECT_THAT(*frame.T_lc, PoseNear(last_cw * Inverse(frame.T_cw), 2e-3, 3e-3));
    }
    if (report.keyframe) {
      ++keyframes;
      const Pose& kept_cw = tracker.map().keyframes.back().T_cw;
      EXPECT_THAT(frame.T_cw, PoseNear(kept_cw, 1e-12, 1e-12)) << "frame " << i;
    }
    last_cw = frame.T_cw;
  }
  EXPECT_GT(keyframes, 2);
}

}  // namespace
}  // namespace slam
