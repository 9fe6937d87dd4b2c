#include "slam/model/map_queries.h"

#include <gtest/gtest.h>

namespace slam {
namespace {

TEST(KeyframesAfter, CountsThoseOfLaterFramesCulledOrNot) {
  Map map;
  EXPECT_EQ(KeyframesAfter(map, 0), 0);
  for (const int frame : {0, 4, 9, 10}) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(map.keyframes.size());
    keyframe.frame_index = frame;
    keyframe.culled = frame == 9;
    map.keyframes.push_back(keyframe);
  }
  EXPECT_EQ(KeyframesAfter(map, kNone), 4);
  EXPECT_EQ(KeyframesAfter(map, 0), 3);  // the frame's own is none of them
  EXPECT_EQ(KeyframesAfter(map, 5), 2);
  EXPECT_EQ(KeyframesAfter(map, 9), 1);
  EXPECT_EQ(KeyframesAfter(map, 10), 0);
}

}  // namespace
}  // namespace slam
