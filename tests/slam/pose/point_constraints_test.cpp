#include "slam/pose/point_constraints.h"

#include <gmock/gmock.h>

namespace slam {
namespace {

using ::testing::ElementsAre;

TEST(PointConstraints, AreOfTheMatchedFeaturesAndOutliersLoseTheirOwnMatch) {
  Map map;
  map.points.resize(3);
  for (int id = 0; id < 3; ++id) {
    map.points[static_cast<std::size_t>(id)].id = id;
    map.points[static_cast<std::size_t>(id)].p_w = {0.1 * id, 0, 2};
  }
  Frame frame;
  frame.features.resize(5);
  frame.map_points = {2, kNone, kNone, 0, 1};
  const FramePoints points = PointConstraints(frame, map, FeatureScale{});
  EXPECT_THAT(points.features, ElementsAre(0, 3, 4));
  EXPECT_EQ(points.constraints[0].p_w, map.points[2].p_w);
  DropOutliers(frame, points, {false, true, false});
  EXPECT_THAT(frame.map_points, ElementsAre(kNone, kNone, kNone, 0, kNone));
}

}  // namespace
}  // namespace slam
