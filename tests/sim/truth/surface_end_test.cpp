// Where surfaces end, seen from straight above and from the side.
#include "sim/truth/surface_end.h"

#include <gtest/gtest.h>

#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr double kDeskHalf_m = 1.0, kBookHalf_m = 0.1;

/// A desk whose top is at z = 0, with a book on it.
Scene DeskWithBook(double height_m) {
  Scene scene;
  scene.objects = {
      BoxObject(1, "desk", Role::kStructure, {0, 0, -0.05}, {2, 2, 0.1}, Print::kPlain),
      BoxObject(2, "book", Role::kRegular, {0, 0, height_m / 2},
                {2 * kBookHalf_m, 2 * kBookHalf_m, height_m}, Print::kPlain)};
  return scene;
}

bool EndsAt(const Scene& scene, const Eigen::Vector3d& eye_w, const Eigen::Vector3d& x_w) {
  return SurfaceEnds(BuildMesh(scene).triangles).At(LookAt(eye_w, {0, 0, 0}), x_w);
}

const Eigen::Vector3d kAbove(0.001, 0.002, 1);  // no line of sight along an edge

TEST(SurfaceEnds, AreAtTheEdgeOfABookThatIsThickerThanTheBreak) {
  for (const double height_m : {0.0003, 0.001, 0.03}) {
    EXPECT_TRUE(EndsAt(DeskWithBook(height_m), kAbove, {kBookHalf_m, 0.03, height_m}))
        << height_m;
    EXPECT_FALSE(EndsAt(DeskWithBook(height_m), kAbove, {0.05, 0.03, height_m})) << height_m;
  }
}

TEST(SurfaceEnds, AreNotWhereBodiesTouchWithinWhatASceneAllows) {
  EXPECT_FALSE(EndsAt(DeskWithBook(0.0001), kAbove, {kBookHalf_m, 0.03, 0.0001}));
}

TEST(SurfaceEnds, AreWhereThereIsNothingBehind) {
  EXPECT_TRUE(EndsAt(DeskWithBook(0.03), kAbove, {kDeskHalf_m, 0.3, 0}));
}

TEST(SurfaceEnds, AreNotAtTheFootOfASideNorAtAnEdgeWithBothSidesInView) {
  const Eigen::Vector3d eye_w(1, 0.1, 0.8);
  const Scene scene = DeskWithBook(0.1);
  EXPECT_FALSE(EndsAt(scene, eye_w, {kBookHalf_m, 0.03, 0}));
  EXPECT_FALSE(EndsAt(scene, eye_w, {kBookHalf_m, 0.03, 0.1}));
  EXPECT_TRUE(EndsAt(scene, eye_w, {-kBookHalf_m, 0.03, 0.1})) << "its far edge";
}

}  // namespace
}  // namespace sim
