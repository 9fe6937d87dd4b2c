#include "eval/surfaces/find_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/eval/surfaces/boards.h"
#include "tests/support/temporary_folder.h"

namespace eval {
namespace {

using testing::Board;
using testing::BoardWorld;

/// Surfaces of a world that is written to a folder of its own.
SurfaceFile SurfacesOf(const BoardWorld& world, double min_area_m2 = 0.15) {
  const test_support::TemporaryFolder folder;
  const Sequence sequence = world.Write(folder.path());
  const DepthViews views(sequence, *sequence.camera, std::nullopt);
  return FindSurfaces(views, min_area_m2);
}

/// A wall of 1.2 x 0.8 m that faces the camera from 2 m.
Board Wall(double x = 0.0, double z = 2.0, double half_width = 0.6) {
  return {{x, 0, z}, {-half_width, 0, 0}, {0, 0.4, 0}};
}

TEST(FindSurfaces, GivesAnExactWallItsAreaAndItsPlane) {
  BoardWorld world;
  world.boards = {Wall()};
  const SurfaceFile file = SurfacesOf(world);
  ASSERT_EQ(file.surfaces.size(), 1u);
  EXPECT_NEAR(AreaOf(file.surfaces[0]), 1.2 * 0.8, 0.03 * 1.2 * 0.8);
  EXPECT_GT(file.surfaces[0].pi_g.n.dot(Eigen::Vector3d(0, 0, -1)), std::cos(1e-3));
  EXPECT_NEAR(std::abs(file.surfaces[0].pi_g.d), 2.0, 1e-3);
  EXPECT_LT(file.surfaces[0].flatness_m, 1e-3);
}

TEST(FindSurfaces, TakesABentWallForOneSurface) {
  // A fixed pattern of the device, 0.33 % of the distance (rms), as a first Kinect's.
  BoardWorld world;
  world.boards = {Wall(0.0, 2.5, 1.0)};
  world.measured = [](double z, int u, int v) {
    return z * (1 + 2 * 0.0033 * std::sin(u / 17.0) * std::cos(v / 25.0));
  };
  const SurfaceFile file = SurfacesOf(world);
  ASSERT_EQ(file.surfaces.size(), 1u);
  EXPECT_NEAR(AreaOf(file.surfaces[0]), 2.0 * 0.8, 0.05 * 2.0 * 0.8);
}

TEST(FindSurfaces, KeepsADeskAndAShelfOverItApart) {
  // Side by side and 25 mm apart, and one before the other.
  BoardWorld world;
  world.boards = {Wall(-0.4, 1.2, 0.3), Wall(0.3, 1.225, 0.4)};
  EXPECT_EQ(SurfacesOf(world).surfaces.size(), 2u);
  world.boards = {Wall(0.0, 1.5, 0.7), Wall(0.1, 1.4, 0.25)};
  EXPECT_EQ(SurfacesOf(world).surfaces.size(), 2u);
}

TEST(FindSurfaces, PartsWhatRaysPassBetweenAndJoinsWhatSomethingHides) {
  BoardWorld world;
  world.boards = {Wall(-0.5, 2.0, 0.3), Wall(0.5, 2.0, 0.3), Wall(0.0, 3.0, 1.5)};
  const SurfaceFile gap = SurfacesOf(world);
  EXPECT_EQ(gap.surfaces.size(), 3u) << SurfacesText(gap);
  // A narrow pillar before the wall; its own front is too small.
  world.boards = {Wall(0.0, 2.0, 0.8), {{0, 0, 1.6}, {-0.05, 0, 0}, {0, 1.0, 0}}};
  EXPECT_EQ(SurfacesOf(world, 0.25).surfaces.size(), 1u);
}

TEST(FindSurfaces, FindsASurfaceWhosePiecesAreSmallerThanWhatIsAskedFor) {
  BoardWorld world;  // the pillar hides the wall's middle from everywhere: twice 0.3 m2
  world.boards = {Wall(0.0, 2.0, 0.6), {{0, 0, 1.6}, {-0.25, 0, 0}, {0, 1.0, 0}}};
  const SurfaceFile found = SurfacesOf(world, 0.5);
  EXPECT_EQ(found.surfaces.size(), 2u) << SurfacesText(found);
}

TEST(FindSurfaces, DoesNotDependOnWhereTheWorldIs) {
  BoardWorld world;
  world.boards = {Wall(-0.4, 1.2, 0.3), Wall(0.4, 1.6, 0.4)};
  const SurfaceFile here = SurfacesOf(world);
  world.T_wg = {
      Eigen::AngleAxisd(0.8, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix(),
      {3.0, -1.0, 0.5}};
  const SurfaceFile there = SurfacesOf(world);
  ASSERT_EQ(here.surfaces.size(), 2u);
  ASSERT_EQ(there.surfaces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    // Cells of 10 mm fall elsewhere: a third of one along the outline of 2.4 m, and by turning.
    EXPECT_NEAR(AreaOf(there.surfaces[i]), AreaOf(here.surfaces[i]),
                0.03 * AreaOf(here.surfaces[i]));
    const Plane moved = Transform(world.T_wg, here.surfaces[i].pi_g);
    EXPECT_GT(moved.n.dot(there.surfaces[i].pi_g.n), std::cos(2e-3));
    EXPECT_NEAR(
        SignedDistance(there.surfaces[i].pi_g, world.T_wg * world.boards[1 - i].middle_g), 0.0,
        2e-3);
  }
}

}  // namespace
}  // namespace eval
