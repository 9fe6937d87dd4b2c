#include "slam/places/carry_map.h"
#include "slam/mapping/plane_motion.h"
#include "slam/model/map_queries.h"

#include <gmock/gmock.h>

#include "tests/support/map_surfaces.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

/// Three keyframes at frames 0, 100 and 200 that a loop has moved, each in its own way; a
/// fourth was culled and follows the second.
struct MovedMap {
  Map map;
  std::vector<Pose> before;
  std::vector<Pose> T_new_old;  ///< of what each keyframe saw

  MovedMap() {
    for (int k = 0; k < 3; ++k) {
      Keyframe keyframe;
      keyframe.id = k;
      keyframe.frame_index = 100 * k;
      keyframe.T_cw = Pose{ExpSo3({0.1 * k, -0.3, 0.2 * k}), {0.3 * k, 0.1, -0.2}};
      map.keyframes.push_back(keyframe);
    }
    Keyframe culled;
    culled.id = 3;
    culled.frame_index = 90;
    culled.culled = true;
    culled.parent = 1;
    culled.T_cp = Pose{ExpSo3({0, 0.4, 0.1}), {0.1, 0.2, 0.0}};
    map.keyframes.push_back(culled);
    before = KeyframePoses(map);
    for (int k = 0; k < 3; ++k) {
      T_new_old.push_back(Pose{ExpSo3({0.05 * k, 0.02, -0.1 * k}), {0.2 * k, -0.1 * k, 0.3}});
      Pose& T_cw = map.keyframes[static_cast<std::size_t>(k)].T_cw;
      T_cw = T_cw * Inverse(T_new_old.back());
    }
    T_new_old.push_back(T_new_old[1]);  // as one with the keyframe that it follows
  }
};

TEST(CarryMap, KnowsWhereACulledKeyframeStands) {
  const MovedMap moved;
  EXPECT_THAT(moved.before[3],
              PoseNear(moved.map.keyframes[3].T_cp * moved.before[1], 1e-12, 1e-12));
}

TEST(CarryMap, APointMovesWithTheKeyframeThatMadeIt) {
  MovedMap moved;
  const Eigen::Vector3d p_w(0.4, -0.7, 1.5);
  for (int k = 0; k < 4; ++k) {
    MapPoint point;
    point.id = k, point.first_keyframe = k, point.p_w = p_w;
    moved.map.points.push_back(point);
  }
  CarryPoints(moved.map, moved.before);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_THAT(moved.map.points[k].p_w,
                VectorNear(Eigen::Vector3d(moved.T_new_old[k] * p_w), 1e-12))
        << k;
  }
}

TEST(CarryMap, APlaneMovesWithTheKeyframeOfItsFirstSightingAndOneOnTrialWithTheNewest) {
  MovedMap moved;
  moved.map.keyframes.pop_back();
  moved.before.pop_back();
  const Eigen::Vector3d centroid_w(0.4, -0.7, 1.5);
  for (const int first_frame : {10, 140, 160}) {
    MapPlane plane;
    plane.first_frame = first_frame;
    plane.centroid_w = centroid_w;
    AddLandmark(moved.map, plane);
  }
  MapPlane trial;
  trial.first_frame = 5;
  trial.centroid_w = centroid_w;
  moved.map.planes.Add(trial);
  CarryPlanes(moved.map, moved.before);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_THAT(Landmarks(moved.map)[k]->centroid_w,
                VectorNear(Eigen::Vector3d(moved.T_new_old[k] * centroid_w), 1e-12))
        << k;
  }
  EXPECT_THAT(Candidates(moved.map)[0]->centroid_w,
              VectorNear(Eigen::Vector3d(moved.T_new_old[2] * centroid_w), 1e-12));
}

TEST(CarryMap, APartOfAPlaneMovesWithIt) {
  const Pose T_new_old{ExpSo3({0.1, 0.2, -0.3}), {0.5, 0, 0.1}};
  MapPlane plane;
  plane.pi_w = {Eigen::Vector3d::UnitZ(), -0.7};
  plane.points_w = {{0.1, 0.2, 0.7}};
  MapPlane moved = plane;
  moved.parts.resize(1);
  moved.parts[0].surface = moved.parts[0].rest = plane;
  MovePlane(moved, T_new_old);
  for (const MapPlane& side : {moved.parts[0].surface, moved.parts[0].rest}) {
    EXPECT_EQ(side.pi_w.n, moved.pi_w.n);
    EXPECT_EQ(side.pi_w.d, moved.pi_w.d);
    EXPECT_EQ(side.points_w, moved.points_w);
  }
}

TEST(CarryMap, APlaneThatAnAdjustmentHasPlacedStays) {
  MovedMap moved;
  MapPlane plane;
  plane.centroid_w = {0.4, -0.7, 1.5};
  for (int i = 0; i < 2; ++i) AddLandmark(moved.map, plane);
  CarryPlanes(moved.map, moved.before, {1});
  EXPECT_GT((moved.map.planes.At(0).centroid_w - plane.centroid_w).norm(), 0.1);
  EXPECT_EQ(moved.map.planes.At(1).centroid_w, plane.centroid_w);
}

TEST(CarryMap, PlanesStayWhereThereIsNoKeyframeToCarryThem) {
  Map map;
  MapPlane plane;
  plane.centroid_w = {0.4, -0.7, 1.5};
  AddLandmark(map, plane);
  CarryPlanes(map, {});
  EXPECT_EQ(map.planes.At(0).centroid_w, plane.centroid_w);
}

}  // namespace
}  // namespace slam
