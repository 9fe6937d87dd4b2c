#include "slam/model/local_map.h"

#include <gmock/gmock.h>

#include "tests/support/point_world.h"

namespace slam {
namespace {

using ::testing::ElementsAre;

/// Keyframes that see points: [keyframe] -> ids.
Map MapOfViews(const std::vector<std::vector<int>>& views, int points) {
  Map map;
  map.points.resize(static_cast<std::size_t>(points));
  for (int id = 0; id < points; ++id) map.points[static_cast<std::size_t>(id)].id = id;
  for (std::size_t k = 0; k < views.size(); ++k) {
    Keyframe keyframe;
    keyframe.id = static_cast<int>(k);
    keyframe.features.resize(views[k].size());
    keyframe.map_points = views[k];
    for (std::size_t f = 0; f < views[k].size(); ++f) {
      map.points[static_cast<std::size_t>(views[k][f])].observations[keyframe.id] =
          static_cast<int>(f);
    }
    map.keyframes.push_back(keyframe);
  }
  for (int k = 0; k < static_cast<int>(views.size()); ++k) UpdateCovisibility(map, k, {});
  return map;
}

TEST(LocalMap, TakesKeyframesByTheirShareOfTheFramesPointsThenTheirNeighbours) {
  // The frame shares 1 point with keyframe 0, 3 with keyframe 2, none with 1 and 3; keyframe 1
  // is tied to keyframe 2, keyframe 3 to nothing.
  const Map map = MapOfViews({{0, 9}, {4, 5, 6}, {1, 2, 3, 4, 5}, {7}}, 10);
  Frame frame;
  frame.map_points = {0, kNone, 1, 2, 3};
  const LocalMap local = GatherLocalMap(frame, map, 10);
  EXPECT_EQ(local.reference, 2);
  EXPECT_THAT(local.keyframes, ElementsAre(2, 0, 1));
  EXPECT_THAT(local.points, ElementsAre(0, 1, 2, 3, 4, 5, 6, 9));
  EXPECT_THAT(GatherLocalMap(frame, map, 1).keyframes, ElementsAre(2));
}

TEST(LocalMap, TakesTheNeighboursOfEachKeyframeThatSeesThePoints) {
  // Keyframe 1 is tied to 0 alone, keyframe 3 to 2 alone; the frame shares points with 0 and 2.
  const Map map = MapOfViews({{0, 1, 4}, {4}, {2, 5}, {5, 6}}, 7);
  Frame frame;
  frame.map_points = {0, 1, 2};
  const LocalMap local = GatherLocalMap(frame, map, 10);
  EXPECT_THAT(local.keyframes, ElementsAre(0, 2, 1, 3));
  EXPECT_THAT(local.points, ElementsAre(0, 1, 2, 4, 5, 6));
}

TEST(LocalMap, FollowsPointsThatWereFusedAndForgetsCulledOnes) {
  Map map = MapOfViews({{0}, {1, 2}}, 4);
  map.points[3].culled = true, map.points[3].replaced_by = 1;
  map.points[0].culled = true;
  Frame frame;
  frame.map_points = {3, 0};
  EXPECT_THAT(GatherLocalMap(frame, map, 10).keyframes, ElementsAre(1));
}

}  // namespace
}  // namespace slam
