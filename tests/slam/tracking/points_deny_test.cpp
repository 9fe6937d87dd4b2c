#include "slam/tracking/points_deny.h"

#include <gtest/gtest.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

/// What a camera at a keyframe of one world sees of another.
Frame FrameOf(const PointWorld& world) {
  Frame frame;
  frame.features = world.map.keyframes[0].features;
  frame.T_cw = world.map.keyframes[0].T_cw;
  return frame;
}

bool Deny(const Frame& frame, const Map& map) {
  return PointsDeny(frame, map, frame.T_cw, 0, Camera{}, FeatureScale{}, {},
                    PointMatchConfig{50, 0.7});
}

TEST(PointsDeny, APlaceWhosePrintsAreOthers) {
  const PointWorld map = MakePointWorld(2, 200, 1);
  EXPECT_FALSE(Deny(FrameOf(map), map.map));
  // Points at the same places, each with the look of another world's.
  Frame other = FrameOf(map);
  Random random{3};
  for (PointFeature& feature : other.features) feature.descriptor = AnyDescriptor(random);
  EXPECT_TRUE(Deny(other, map.map));
  // One in ten is known again: lamps and shadows have changed.
  for (std::size_t f = 0; f < other.features.size(); f += 10)
    other.features[f].descriptor = map.map.keyframes[0].features[f].descriptor;
  EXPECT_FALSE(Deny(other, map.map));
}

TEST(PointsDeny, APlaceWhereFewerThanTwoInAHundredLookAlike) {
  const PointWorld map = MakePointWorld(2, 200, 1);
  for (const std::size_t alike : {2u, 8u}) {
    Frame other = FrameOf(map);
    Random random{3};
    for (std::size_t f = alike; f < other.features.size(); ++f)
      other.features[f].descriptor = AnyDescriptor(random);
    ASSERT_GT(other.features.size(), 150u);  // of which two in a hundred are between the two
    ASSERT_LT(other.features.size(), 300u);
    EXPECT_EQ(Deny(other, map.map), alike == 2) << alike;
  }
}

TEST(PointsDeny, APlaceThatOneKeyframeAloneKnows) {
  const PointWorld map = MakePointWorld(1, 200, 1);
  ASSERT_TRUE(map.map.keyframes[0].covisible.empty());
  Frame other = FrameOf(map);
  EXPECT_FALSE(Deny(other, map.map));
  Random random{3};
  for (PointFeature& feature : other.features) feature.descriptor = AnyDescriptor(random);
  EXPECT_TRUE(Deny(other, map.map));
}

TEST(PointsDeny, NothingInTheDarkNorWhereTheMapHasNoPoints) {
  const PointWorld map = MakePointWorld(2, 200, 1);
  Frame dark = FrameOf(map);
  dark.features.clear();
  EXPECT_FALSE(Deny(dark, map.map));
  PointWorld bare = MakePointWorld(2, 40, 2);
  EXPECT_FALSE(Deny(FrameOf(map), bare.map));
}

}  // namespace
}  // namespace slam
