#include "sim/motion/free_space.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

/// One upright slab, 2 cm thick, square to x.
FreeSpace SlabAt(double x_m, Role role) {
  Scene scene;
  scene.objects.emplace_back();
  scene.objects[0].role = role;
  scene.objects[0].center_w = {x_m, 0, 1};
  scene.objects[0].size = {0.02, 2, 2};
  return FreeSpace(scene);
}

TEST(FreeSpace, SeesNothingThroughAWallButForTheLastTenCentimetres) {
  const Eigen::Vector3d from_w(-2, 0, 1.2), to_w(0, 0, 0.8);
  for (const double before_m : {1.9, 1.2, 0.9, 0.5, 0.2, 0.13}) {
    EXPECT_FALSE(SlabAt(-before_m, Role::kStructure).InSight(from_w, to_w)) << before_m;
  }
  EXPECT_TRUE(SlabAt(-0.05, Role::kStructure).InSight(from_w, to_w));
  EXPECT_TRUE(SlabAt(0.5, Role::kStructure).InSight(from_w, to_w)) << "behind the target";
  EXPECT_TRUE(SlabAt(-2.5, Role::kStructure).InSight(from_w, to_w)) << "behind the camera";
  EXPECT_TRUE(SlabAt(-1, Role::kRegular).InSight(from_w, to_w)) << "no floor, wall or desk";
}

}  // namespace
}  // namespace sim
