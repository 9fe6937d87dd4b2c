#include <gmock/gmock.h>

#include "tests/support/furnished_room.h"
#include "tests/support/stream_run.h"

// A camera that was lost comes back in the dark: depth alone says where it is.
namespace slam {
namespace {

Pose SlidingHandAt(int i) {
  const double s = i / 30.0;
  return LookAt({-0.5 + 0.1 * std::sin(3 * s), -0.6 + 0.1 * s, 1.3}, {0.5, 1.1, 0.3});
}

/// A dark room, without depth as well from frame `from` for `count` frames.
std::vector<RecordedFrame> DarkStream(const PlaneWorld& world, int frames, int from,
                                      int count) {
  const Camera camera = CameraOfSize(320, 240);
  std::vector<RecordedFrame> stream;
  for (int i = 0; i < frames; ++i) {
    cv::Mat1f depth_m = See(world, SlidingHandAt(i), camera, {}, Random{1}).frame.depth_m;
    if (i >= from && i < from + count) depth_m.setTo(0);
    stream.push_back(StreamFrame(i, cv::Mat1b(depth_m.size(), 0), depth_m));
  }
  return stream;
}

TEST(FoundByPlanes, ACameraThatWasCoveredKnowsItsPlaceAtOnce) {
  constexpr int kFrom = 20, kCovered = 10;
  const Ran ran = RunOn(DarkStream(FurnishedRoom(), 50, kFrom, kCovered), Variant::kFull);
  ASSERT_EQ(ran.states[kFrom - 1], "planes");
  for (int i = kFrom; i < kFrom + kCovered; ++i) EXPECT_EQ(ran.states[Index(i)], "lost") << i;
  EXPECT_EQ(ran.states[kFrom + kCovered], "relocalised");
  EXPECT_EQ(ran.states.back(), "planes");
  ASSERT_EQ(ran.outcome.tracked, 50 - kCovered);
  for (const auto& [s, T_wc] : ran.poses_wc) {
    const int i = static_cast<int>(std::lround((s - 100.0) * 30));
    EXPECT_LT((T_wc.t - (SlidingHandAt(0) * Inverse(SlidingHandAt(i))).t).norm(), 0.02) << i;
  }
}

TEST(FoundByPlanes, NotByPointsAlone) {
  const Ran ran = RunOn(DarkStream(FurnishedRoom(), 25, 10, 5), Variant::kPoints);
  EXPECT_EQ(ran.outcome.tracked, 0);
}

/// Carried into a room where the boxes stand otherwise: the map is not taken for that room, and
/// stays as it was.
TEST(FoundByPlanes, ACameraInAnotherRoomStaysLost) {
  auto stream = DarkStream(FurnishedRoom(), 50, 20, 10);
  const auto elsewhere = DarkStream(FurnishedRoom(-0.25), 50, 20, 10);
  std::copy(elsewhere.begin() + 30, elsewhere.end(), stream.begin() + 30);
  const Ran ran = RunOn(stream, Variant::kFull),
            before = RunOn(DarkStream(FurnishedRoom(), 20, 20, 0), Variant::kFull);
  for (int i = 20; i < 50; ++i)
    EXPECT_THAT(ran.states[Index(i)], testing::AnyOf("lost", "ambiguous")) << i;
  EXPECT_EQ(ran.map, before.map);
}

}  // namespace
}  // namespace slam
