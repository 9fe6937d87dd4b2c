#include "slam/model/map_queries.h"

#include <gmock/gmock.h>

#include "tests/support/slam_matchers.h"

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

TEST(KeyframePose, FollowsAChainOfCulledKeyframes) {
  const Pose T_0w{ExpSo3({0.3, -0.2, 0.5}), {0.4, 0.1, -0.3}};
  const Pose T_10{ExpSo3({-0.1, 0.6, 0.2}), {0.2, -0.5, 0.1}};
  const Pose T_21{ExpSo3({0.4, 0.3, -0.7}), {-0.3, 0.2, 0.6}};
  Map map;
  map.keyframes.resize(3);
  for (int id = 0; id < 3; ++id) map.keyframes[static_cast<std::size_t>(id)].id = id;
  map.keyframes[0].T_cw = T_0w;
  map.keyframes[1].culled = map.keyframes[2].culled = true;
  map.keyframes[1].parent = 0, map.keyframes[1].T_cp = T_10;
  map.keyframes[2].parent = 1, map.keyframes[2].T_cp = T_21;
  const Eigen::Vector3d x_w(0.7, -0.4, 1.9);
  EXPECT_THAT(KeyframePose(map, 0) * x_w, VectorNear(T_0w * x_w, 1e-12));
  EXPECT_THAT(KeyframePose(map, 1) * x_w, VectorNear(T_10 * (T_0w * x_w), 1e-12));
  EXPECT_THAT(KeyframePose(map, 2) * x_w, VectorNear(T_21 * (T_10 * (T_0w * x_w)), 1e-12));
}

TEST(NearestKeyframe, GoesByPlaceAndDirectionARadianBeingAMetre) {
  const Pose T_cw{ExpSo3({0.3, -0.2, 0.5}), {0.4, 0.1, -0.3}};
  Map map;
  EXPECT_EQ(NearestKeyframe(map, T_cw), kNone);
  map.keyframes.resize(2);
  Keyframe &beside = map.keyframes[0], &turned = map.keyframes[1];
  beside.id = 0, turned.id = 1;
  // The one looks the same way from so far aside, the other 0.5 rad away from the same place.
  turned.T_cw = Pose{ExpSo3({0.0, 0.5, 0.0}), Eigen::Vector3d::Zero()} * T_cw;
  for (const double aside_m : {0.1, 0.4, 0.6, 2.0}) {
    beside.T_cw = Pose{Eigen::Matrix3d::Identity(), {aside_m, 0, 0}} * T_cw;
    EXPECT_EQ(NearestKeyframe(map, T_cw), aside_m < 0.5 ? 0 : 1) << aside_m;
  }
  turned.culled = true;
  EXPECT_EQ(NearestKeyframe(map, T_cw), 0);
}

}  // namespace
}  // namespace slam
