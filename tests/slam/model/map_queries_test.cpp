#include "slam/model/map_queries.h"

#include <gmock/gmock.h>

#include <stdexcept>
#include <vector>

#include "tests/support/map_surfaces.h"
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

std::vector<int> Ids(const Map& map) {
  std::vector<int> ids;
  for (const MapPlane& plane : map.planes) ids.push_back(plane.id);
  return ids;
}

TEST(MapPlanes, NeverGiveAnIdAgainAndFindEachByItsOwn) {
  Map map;
  AddLandmark(map, {});
  for (int k = 0; k < 3; ++k) map.planes.Add({});
  map.planes.EraseCandidates([](const MapPlane& plane) { return plane.id != 2; });
  EXPECT_THAT(Ids(map), testing::ElementsAre(0, 2))
      << "landmarks stay whatever is said of them";
  EXPECT_EQ(map.planes.Add({}).id, 4);
  map.planes.EraseCandidates([](const MapPlane& plane) { return plane.id == 4; });
  EXPECT_EQ(map.planes.Add({}).id, 5) << "though the last one has gone";
  for (const int id : {0, 2, 5}) EXPECT_EQ(map.planes.At(id).id, id);
  for (const int id : {-1, 1, 4, 6}) {
    EXPECT_EQ(map.planes.Find(id), nullptr) << id;
    EXPECT_THROW(map.planes.At(id), std::out_of_range) << id;
  }
}

TEST(CurrentPlane, IsTheLastOfAChainOfMergers) {
  Map map;
  for (int k = 0; k < 4; ++k) AddLandmark(map, {});
  map.planes.At(3).merged_into = 1;
  map.planes.At(1).merged_into = 2;
  for (const int id : {1, 2, 3}) EXPECT_EQ(CurrentPlane(map, id), 2) << id;
  EXPECT_EQ(CurrentPlane(map, 0), 0);
}

TEST(CurrentPoint, IsTheLastOfAChainOfFusionsUnlessThatWasCulled) {
  Map map;
  map.points.resize(4);
  map.points[0].replaced_by = 2, map.points[2].replaced_by = 1;
  map.points[0].culled = map.points[2].culled = true;
  EXPECT_EQ(CurrentPoint(map, 0), 1);
  map.points[3].culled = true;
  EXPECT_EQ(CurrentPoint(map, 3), kNone);
  map.points[1].culled = true;
  EXPECT_EQ(CurrentPoint(map, 0), kNone);
  EXPECT_EQ(CurrentPoint(map, kNone), kNone);
}

TEST(StepLiesBetween, WhereMostFramesWithBothShowedOneAndMoreThanOneDid) {
  struct Case {
    int stepped, together;
    bool expected;
  };
  for (const Case& c : {Case{0, 5, false},
                        {1, 1, false},
                        {2, 2, true},
                        {2, 3, true},
                        {2, 4, false},
                        {3, 4, true},
                        {5, 10, false},
                        {6, 10, true}}) {
    MapPlane one, other, third;
    one.id = 3, other.id = 7, third.id = 8;
    if (c.stepped > 0) one.stepped[other.id] = c.stepped;
    one.covisible[other.id] = c.together;
    EXPECT_EQ(StepLiesBetween(one, other), c.expected) << c.stepped << " of " << c.together;
    EXPECT_FALSE(StepLiesBetween(one, third)) << "another landmark's frames say nothing";
  }
  MapPlane one, other;
  other.id = 7, one.stepped[7] = 2;  // that both were seen has not been counted yet
  EXPECT_TRUE(StepLiesBetween(one, other));
}

TEST(NearestVertex, IsTheNearestOfThoseThatAreNearEnough) {
  MapPlane plane;
  plane.vertices_w = {{0, 0, 0}, {0.3, 0, 0}, {0.3, 0.2, 0}, {0, 0.2, 0}};
  for (std::size_t k = 0; k < plane.vertices_w.size(); ++k) {
    const Eigen::Vector3d p_w = plane.vertices_w[k] + Eigen::Vector3d(0.01, -0.02, 0.02);
    EXPECT_EQ(NearestVertex(plane, p_w, 10.0), k) << "all are near enough";
    EXPECT_EQ(NearestVertex(plane, p_w, 0.031), k);
    EXPECT_EQ(NearestVertex(plane, p_w, 0.029), std::nullopt);
  }
  EXPECT_EQ(NearestVertex({}, {0, 0, 0}, 10.0), std::nullopt);
}

TEST(MatchedPoints, AreThoseOfTheMapThatWereNotCulled) {
  Map map;
  map.points.resize(3);
  map.points[1].culled = true;
  Frame frame;
  frame.features.resize(6);
  frame.map_points = {kNone, 2, 1, 3, 0};  // one is of no map, the last feature was not asked
  std::vector<std::pair<std::size_t, int>> found;
  for (const MatchedPoint& match : MatchedPoints(frame, map))
    found.emplace_back(match.feature, match.point);
  EXPECT_THAT(found, testing::ElementsAre(std::pair(1u, 2), std::pair(4u, 0)));
}

TEST(MostCountedFirst, GoesByTheCountAndThenByTheId) {
  EXPECT_THAT(MostCountedFirst({{1, 2}, {4, 9}, {5, 2}, {6, 1}, {9, 2}, {12, 9}}),
              testing::ElementsAre(4, 12, 1, 5, 9, 6));
}

}  // namespace
}  // namespace slam
