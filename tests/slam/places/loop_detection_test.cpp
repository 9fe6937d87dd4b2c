#include "slam/places/loop_detection.h"

#include <gtest/gtest.h>

#include "slam/base/index.h"
#include "tests/support/ring_world.h"

namespace slam {
namespace {

constexpr int kNewest = 39, kBeside = 38;

bool FindsALoop(const RingWorld& world) {
  KeyframeIndex index(world.vocabulary);
  index.Update(world.map);
  return DetectLoop(world.map, index, kNewest, world.camera, FeatureScale{}, {}, {})
      .has_value();
}

void ShareAPoint(Map& map, int one, int other) {
  map.keyframes[Index(one)].covisible[other] = map.keyframes[Index(other)].covisible[one] = 1;
}

// That a keyframe sees again what it or a neighbour of it is tied to is no news.
TEST(LoopDetection, SeesNoLoopToWhatItsNeighboursAreTiedTo) {
  const RingWorld world = MakeRingWorld();
  ASSERT_TRUE(FindsALoop(world));
  ASSERT_EQ(world.map.keyframes[kNewest].covisible.count(kBeside), 1u);
  for (const int tied : {kNewest, kBeside}) {
    RingWorld known = world;
    for (int start = 0; start < 10; ++start) ShareAPoint(known.map, tied, start);
    EXPECT_FALSE(FindsALoop(known)) << tied;
  }
}

}  // namespace
}  // namespace slam
