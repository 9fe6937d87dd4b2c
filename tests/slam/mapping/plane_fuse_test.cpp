#include "slam/mapping/plane_fuse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "slam/associate/plane_comparison.h"
#include "slam/mapping/plane_cloud.h"
#include "tests/support/map_surfaces.h"

namespace slam {
namespace {

/// A board of 0.4 m by 0.3 m at a height, known to 2 mm and 2 mrad, that ten frames saw.
MapPlane FlatBoard(double height_m) {
  MapPlane board;
  board.pi_w = {Eigen::Vector3d::UnitZ(), -height_m};
  board.centroid_w = {0, 0, height_m};
  AddObservation(board.estimate, board.pi_w, board.centroid_w, 0.002, 0.002, 1.0);
  board.voxel_m = PlaneMapConfig{}.voxel_m;
  for (double x = -0.19; x < 0.2; x += 0.02)
    for (double y = -0.14; y < 0.15; y += 0.02) board.points_w.emplace_back(x, y, height_m);
  Outline outline = ConvexOutline(board.points_w, board.pi_w);
  board.hull_w = outline.hull_w;
  board.area_m2 = outline.area_m2;
  board.observations = 10;
  return board;
}

/// Two boards, so far apart that chi-square is a share of what is allowed.
Map TwoBoards(double share) {
  constexpr double kApart_m = 0.001;
  const double at_one = ComparePlanes(FlatBoard(0), FlatBoard(kApart_m)).chi2;
  Map map;
  AddLandmark(map, FlatBoard(0));
  AddLandmark(map,
              FlatBoard(kApart_m * std::sqrt(share * AssociationConfig{}.max_chi2 / at_one)));
  return map;
}

// Segments that stood side by side again and again have shown any step there is: half of the
// chi-square is allowed. As many frames as a landmark needs before it is asked are again and again.
TEST(PlaneFuse, AsksMoreOfSurfacesThatWereSeenSideBySide) {
  const int often = PlaneMapConfig{}.min_fused_observations;
  for (const int together : {often - 1, often, often + 3}) {
    for (const double share : {0.4, 0.6, 0.9, 1.1}) {
      Map map = TwoBoards(share);
      map.planes.At(0).covisible[1] = map.planes.At(1).covisible[0] = together;
      const bool one = share < (together < often ? 1.0 : 0.5);
      EXPECT_EQ(FusePlanes(map, {}, {}), one ? 1 : 0) << together << " " << share;
    }
  }
}

TEST(PlaneFuse, AsksNothingOfSurfacesThatWereHardlySeen) {
  for (const int less : {0, 1}) {
    for (const int which : {0, 1}) {
      Map map = TwoBoards(0.1);
      map.planes.At(which).observations = PlaneMapConfig{}.min_fused_observations - less;
      EXPECT_EQ(FusePlanes(map, {}, {}), less == 0 ? 1 : 0) << which;
    }
  }
}

// Whichever has the lower id.
TEST(PlaneFuse, AFusedSurfaceIsAsOldAsTheOlderAndAsNewAsTheNewer) {
  for (const bool older_first : {true, false}) {
    for (const bool inside : {true, false}) {  // the one's time lies within the other's
      Map map = TwoBoards(0.1);
      MapPlane &older = map.planes.At(older_first ? 0 : 1),
               &other = map.planes.At(older_first ? 1 : 0);
      older.first_frame = 3, older.first_seen_s = 0.3;
      other.first_frame = 7, other.first_seen_s = 0.7;
      older.last_frame = inside ? 90 : 50, older.last_seen_s = inside ? 9.0 : 5.0;
      other.last_frame = 80, other.last_seen_s = 8.0;
      ASSERT_EQ(FusePlanes(map, {}, {}), 1);
      const MapPlane& whole = map.planes.At(0);
      EXPECT_EQ(whole.first_frame, 3);
      EXPECT_EQ(whole.first_seen_s, 0.3);
      EXPECT_EQ(whole.last_frame, inside ? 90 : 80);
      EXPECT_EQ(whole.last_seen_s, inside ? 9.0 : 8.0);
    }
  }
}

// What all frames err by alike is told by how many there were.
TEST(PlaneFuse, AFusedSurfaceWasSeenInTheFramesOfBothAndHoldsWhatBothHeld) {
  Map map = TwoBoards(0.1);
  for (int i = 0; i < 6; ++i) {
    MapPlane& m = map.planes.At(1);
    AddObservation(m.estimate, m.pi_w, m.centroid_w, 0.002, 0.002, 1.0);
  }
  map.points.resize(4);
  map.planes.At(0).map_points = {0, 1}, map.planes.At(1).map_points = {1, 3};
  map.planes.At(1).parts.resize(1);
  const double frames = map.planes.At(0).estimate.frames + map.planes.At(1).estimate.frames;
  ASSERT_EQ(FusePlanes(map, {}, {}), 1);
  EXPECT_NEAR(map.planes.At(0).estimate.frames, frames, 1e-9);
  EXPECT_EQ(map.planes.At(0).map_points, (std::set<int>{0, 1, 3}));
  const MapPlane& gone = map.planes.At(1);
  EXPECT_TRUE(gone.map_points.empty() && gone.points_w.empty() && gone.parts.empty());
}

TEST(PlaneFuse, CoversWhatEitherOutlineDidThoughItsPointsAreGone) {
  Map map = TwoBoards(0.1);
  for (const int which : {0, 1}) {
    MapPlane& m = map.planes.At(which);
    const double x_m = which == 0 ? -0.4 : 0.6;  // once seen there
    m.hull_w = {{0, -0.1, 0}, {x_m, 0, 0}, {0, 0.1, 0}};
  }
  ASSERT_EQ(FusePlanes(map, {}, {}), 1);
  for (const double x_m : {-0.4, 0.6}) {
    double nearest_m = 1.0;
    for (const Eigen::Vector3d& p_w : map.planes.At(0).hull_w)
      nearest_m = std::min(nearest_m, (p_w - Eigen::Vector3d(x_m, 0, 0)).norm());
    EXPECT_LT(nearest_m, 0.01) << x_m;
  }
}

TEST(PlaneFuse, ForgetsPointsThatWereCulledAlsoOfSurfacesThatStayAsTheyAre) {
  Map map;
  AddLandmark(map, FlatBoard(0));
  map.points.resize(3);
  map.points[1].culled = true;
  map.planes.At(0).map_points = {0, 1, 2, 5};  // of the last nothing is known
  EXPECT_EQ(FusePlanes(map, {}, {}), 0);
  EXPECT_EQ(map.planes.At(0).map_points, (std::set<int>{0, 2}));
}

}  // namespace
}  // namespace slam
