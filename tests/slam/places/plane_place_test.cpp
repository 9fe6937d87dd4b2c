#include "slam/places/plane_place.h"

#include <gtest/gtest.h>

#include "slam/mapping/plane_cloud.h"
#include "tests/support/furnished_room.h"
#include "tests/support/map_surfaces.h"
#include "tests/support/normal_draws.h"
#include "tests/support/slam_matchers.h"

namespace slam {
namespace {

const ViewFaults kNoisy{1.0, 0.0, 0.0, 0.0, 0.0};

/// The map of a world of which the views showed some.
Map MapOf(const PlaneWorld& world, const std::vector<Pose>& views_cw, const Camera& camera) {
  std::vector<MapPlane> known(world.planes.size());
  for (const Pose& T_cw : views_cw) {
    const SeenWorld seen = See(world, T_cw, camera, {}, Random{1});
    for (const FramePlane& plane : seen.frame.planes) {
      MapPlane& landmark = known[Index(seen.truth[Index(plane.index)])];
      landmark.pi_w = world.planes[Index(seen.truth[Index(plane.index)])].pi_w();
      landmark.class_name = plane.class_name;
      std::vector<Eigen::Vector3d> points_w;
      for (const Eigen::Vector3d& p_c : plane.points_c) points_w.push_back(Inverse(T_cw) * p_c);
      landmark.voxel_m = MergeIntoCloud(landmark.points_w, points_w, landmark.pi_w,
                                        Eigen::Vector3d::Zero(), 0.02, 2000);
      if (plane.vertices_c.size() != kFaceCorners) continue;
      landmark.vertices_w.clear();
      for (const Vertex& vertex : plane.vertices_c)
        landmark.vertices_w.push_back(Inverse(T_cw) * vertex.p_c);
    }
  }
  Map map;
  for (MapPlane& landmark : known) {
    if (landmark.points_w.empty()) continue;
    const Outline outline = ConvexOutline(landmark.points_w, landmark.pi_w);
    landmark.hull_w = outline.hull_w;
    landmark.area_m2 = outline.area_m2;
    for (const Eigen::Vector3d& p_w : landmark.points_w) landmark.centroid_w += p_w;
    landmark.centroid_w /= static_cast<double>(landmark.points_w.size());
    AddLandmark(map, landmark);
  }
  return map;
}

std::vector<Pose> RoomViews() {
  return {LookAt({-0.8, -0.8, 1.2}, {0.6, 1.2, 0.3}), LookAt({0.2, -1.0, 1.2}, {0.4, 1.2, 0.3}),
          LookAt({-0.9, 0.2, 1.2}, {0.9, 0.9, 0.3})};
}

const Pose kSeenFrom = LookAt({-0.5, -0.6, 1.3}, {0.5, 1.1, 0.3});

PlanePlace Find(const PlaneWorld& world, const Map& map, const Pose& T_cw,
                const Camera& camera = SmallCamera(), const ViewFaults& faults = kNoisy) {
  const Frame frame = See(world, T_cw, camera, faults, Random{7}).frame;
  return FindPlaceByPlanes(frame, map, camera, {}, {});
}

TEST(PlanePlace, OfARoomIsFoundByItsAnglesAndDistances) {
  const Map map = MapOf(FurnishedRoom(), RoomViews(), SmallCamera());
  for (const Pose& T_cw :
       {kSeenFrom, RoomViews()[0], LookAt({0, -0.9, 1.4}, {0.8, 0.9, 0.4})}) {
    const PlanePlace place = Find(FurnishedRoom(), map, T_cw);
    ASSERT_TRUE(place.pose);
    EXPECT_THAT(place.pose->T_cw, PoseNear(T_cw, 0.003, 0.004));
    EXPECT_FALSE(place.ambiguous);
    // With the planes it is known better than before they were counted.
    for (int k = 0; k < 6; ++k)
      EXPECT_LT(place.pose->covariance(k, k), place.before(k, k)) << k;
  }
}

TEST(PlanePlace, IsTheSameWhereverTheWorldLies) {
  const Map map = MapOf(FurnishedRoom(), RoomViews(), SmallCamera());
  const Pose T_vw{ExpSo3({0.4, -1.1, 0.7}), {3, -2, 5}};
  Map moved;
  for (MapPlane plane : map.planes) {
    plane.pi_w = Transform(T_vw, plane.pi_w);
    plane.centroid_w = T_vw * plane.centroid_w;
    for (auto* points : {&plane.points_w, &plane.hull_w, &plane.vertices_w}) {
      for (Eigen::Vector3d& p_w : *points) p_w = T_vw * p_w;
    }
    AddLandmark(moved, plane);
  }
  const PlanePlace here = Find(FurnishedRoom(), map, kSeenFrom),
                   there = Find(FurnishedRoom(), moved, kSeenFrom);
  ASSERT_TRUE(here.pose && there.pose);
  EXPECT_THAT(there.pose->T_cw, PoseNear(here.pose->T_cw * Inverse(T_vw), 1e-3, 1e-3));
}

TEST(PlanePlace, IsNotThatOfARoomWhoseBoxesStandElsewhere) {
  const Map map = MapOf(FurnishedRoom(), RoomViews(), SmallCamera());
  for (const double moved_m : {0.15, 0.3, -0.2}) {
    const PlanePlace place = Find(FurnishedRoom(moved_m), map, kSeenFrom);
    EXPECT_FALSE(place.pose) << moved_m << " m";
  }
}

/// Nothing speaks against the place: the new boxes hide what the map knows.
TEST(PlanePlace, IsNotBelievedWhereMostOfWhatIsSeenIsNew) {
  PlaneWorld full = FurnishedRoom();
  for (const double x : {-0.9, -0.3, 0.3, 0.9}) {
    full.AddBox({x, 0.3, 0}, {0.3, 0.2, 0.35}, 0.4, "");
    full.AddBox({x + 0.2, 0.75, 0}, {0.25, 0.2, 0.6}, -0.3, "");
  }
  EXPECT_FALSE(Find(full, MapOf(FurnishedRoom(), RoomViews(), SmallCamera()), kSeenFrom).pose);
}

TEST(GuessedPlaces, HoldTheTrueOneBetweenWallsThatAreNotSquare) {
  PlaneWorld world;
  const double skew = 0.6;
  world.Add({0, 0, 0}, {2, 0, 0}, {0, 2, 0}, "");
  world.Add({0, 2, 1}, {2, 0, 0}, {0, 0, 1}, "");
  world.Add({2, 0, 1}, {0, 0, 1}, {2 * std::sin(skew), 2 * std::cos(skew), 0}, "");
  const Map map = MapOf(world, RoomViews(), SmallCamera());
  const Frame frame = See(world, kSeenFrom, SmallCamera(), {}, Random{7}).frame;
  ASSERT_EQ(frame.planes.size(), 3u);
  double nearest_m = 1.0;
  for (const UncertainPose& guess : GuessPlaces(frame, KnownPlanes(map), {})) {
    const Pose off = guess.T_cw * Inverse(kSeenFrom);
    if (Log(off).tail<3>().norm() < 0.01) nearest_m = std::min(nearest_m, off.t.norm());
  }
  EXPECT_LT(nearest_m, 0.01);
}

/// The square of how far a guess is off, in its own standard deviations: six on average.
TEST(GuessedPlaces, ByCornersScatterAsTheySayWhereFrameAndMapErrAlike) {
  constexpr int kDraws = 600;
  constexpr double kCorner_m = 0.001;
  PlanePlaceConfig config;
  config.max_offset_m = 1e-4, config.max_side_share = 0.2;  // the corners' own errors alone
  const std::vector<Eigen::Vector3d> face_w{
      {-0.15, -0.08, 0}, {0.15, -0.08, 0}, {0.15, 0.08, 0}, {-0.15, 0.08, 0}};
  const Pose T_cw = LookAt({-0.1, -0.5, 0.6}, {0, 0, 0});
  Random random{12};
  const auto off = [&]() -> Eigen::Vector3d {
    return kCorner_m * Eigen::Vector3d(Normal(random), Normal(random), Normal(random));
  };
  double sum = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    FramePlane plane;
    plane.pi_c = Transform(T_cw, Plane{Eigen::Vector3d::UnitZ(), 0.0});
    plane.centroid_c = T_cw.t;
    plane.pixel_count = 1000;
    MapPlane landmark;
    landmark.pi_w = {Eigen::Vector3d::UnitZ(), 0.0};
    for (const Eigen::Vector3d& p_w : face_w) {
      plane.vertices_c.push_back(
          {T_cw * p_w + off(), false, kCorner_m * kCorner_m * Eigen::Matrix3d::Identity()});
      landmark.vertices_w.push_back(p_w + off());
    }
    Map map;
    AddLandmark(map, landmark);
    Frame frame;
    frame.planes = {plane};
    const auto guesses = GuessPlaces(frame, KnownPlanes(map), config);
    ASSERT_EQ(guesses.size(), 2u) << "a face looks the same half a turn about";
    double square = INFINITY;
    for (const UncertainPose& guess : guesses) {
      const Vector6d xi = Log(T_cw * Inverse(guess.T_cw));
      square = std::min(square, xi.dot(guess.covariance.inverse() * xi));
    }
    sum += square;
  }
  EXPECT_NEAR(sum / kDraws, 6.0, 4 * std::sqrt(2 * 6.0 / kDraws));
}

TEST(PlanePlace, OfABareCornerIsNotFound) {
  PlaneWorld corner = FurnishedRoom();
  corner.planes.resize(3);
  EXPECT_FALSE(Find(corner, MapOf(corner, RoomViews(), SmallCamera()), kSeenFrom).pose)
      << "every corner of every room looks so";
}

/// Another room 10 m beside, of which the map holds as much.
TEST(PlanePlace, IsAmbiguousWhereTheMapHoldsALookAlike) {
  PlaneWorld both = FurnishedRoom();
  const auto count = both.planes.size();
  for (std::size_t i = 0; i < count; ++i) {
    WorldPlane plane = both.planes[i];
    plane.center_w.x() += 10;
    both.planes.push_back(plane);
  }
  std::vector<Pose> views = RoomViews();
  for (const Pose& T_cw : RoomViews())
    views.push_back(T_cw * Pose{Eigen::Matrix3d::Identity(), {-10, 0, 0}});
  const PlanePlace place = Find(FurnishedRoom(), MapOf(both, views, SmallCamera()), kSeenFrom);
  EXPECT_FALSE(place.pose);
  EXPECT_TRUE(place.ambiguous);
}

TEST(PlanePlace, OfLookAlikesIsToldByClasses) {
  // The same rooms, but what is a suitcase here is a box there.
  PlaneWorld here = FurnishedRoom();
  for (WorldPlane& plane : here.planes)
    if (plane.object >= 3) plane.class_name = "suitcase";
  PlaneWorld both = here;
  for (WorldPlane plane : here.planes) {
    plane.center_w.x() += 10;
    if (plane.object >= 3) plane.class_name = "box";
    plane.object += here.objects;
    both.planes.push_back(plane);
  }
  both.objects *= 2;
  std::vector<Pose> views = RoomViews();
  for (const Pose& T_cw : RoomViews())
    views.push_back(T_cw * Pose{Eigen::Matrix3d::Identity(), {-10, 0, 0}});
  const PlanePlace place = Find(here, MapOf(both, views, SmallCamera()), kSeenFrom);
  ASSERT_TRUE(place.pose);
  EXPECT_THAT(place.pose->T_cw, PoseNear(kSeenFrom, 0.003, 0.004));
}

/// Books on a desk: all that is seen faces up, and only corners tell a place.
PlaneWorld Desk(bool one_book) {
  PlaneWorld world;
  world.Add({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, "");
  const auto book = [&](double x, double y, double z, double half_x, double half_y) {
    world.Add({x, y, z}, {half_x, 0, 0}, {0, half_y, 0}, "book");
  };
  book(0.05, 0.1, 0.03, 0.14, 0.1);
  if (one_book) return world;
  book(-0.3, 0.15, 0.02, 0.1, 0.075);
  book(0.1, -0.25, 0.04, 0.12, 0.09);
  book(-0.25, -0.2, 0.015, 0.08, 0.06);
  return world;
}

const Pose kAboveDesk = LookAt({-0.1, -0.7, 0.9}, {0, 0, 0});

TEST(PlanePlace, OfADeskIsFoundByTheCornersOfItsBooks) {
  Camera camera = SmallCamera();
  const Map map = MapOf(Desk(false), {LookAt({0, -0.6, 1.0}, {0, 0, 0})}, camera);
  const PlanePlace place = Find(Desk(false), map, kAboveDesk, camera, {});
  ASSERT_TRUE(place.pose);
  EXPECT_THAT(place.pose->T_cw, PoseNear(kAboveDesk, 0.01, 0.015));
  // Corners hold it along the desk, more loosely than planes across.
  const Matrix6d& covariance = place.pose->covariance;
  EXPECT_LT(std::sqrt(covariance.diagonal().head<3>().maxCoeff()), 0.02);
}

TEST(PlanePlace, OfOneBookIsNotTold) {
  Camera camera = SmallCamera();
  PlanePlaceConfig config;
  config.min_planes = 2;
  const Map map = MapOf(Desk(true), {kAboveDesk}, camera);
  const Frame frame = See(Desk(true), kAboveDesk, camera, {}, Random{7}).frame;
  const PlanePlace place = FindPlaceByPlanes(frame, map, camera, config, {});
  EXPECT_TRUE(place.ambiguous) << "half a turn about, it looks the same";
  EXPECT_FALSE(place.pose);
}

TEST(PlanePlace, OfNothingIsNotFound) {
  EXPECT_FALSE(FindPlaceByPlanes(Frame{}, Map{}, SmallCamera(), {}, {}).pose);
  const Map map = MapOf(FurnishedRoom(), RoomViews(), SmallCamera());
  EXPECT_FALSE(FindPlaceByPlanes(Frame{}, map, SmallCamera(), {}, {}).pose);
  EXPECT_FALSE(Find(FurnishedRoom(), Map{}, kSeenFrom).pose);
}

}  // namespace
}  // namespace slam
