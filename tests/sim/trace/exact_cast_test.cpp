#include "sim/trace/exact_cast.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

TEST(ExactCaster, MeetsATriangleFromEitherSideAndTellsWhich) {
  Triangle triangle;
  triangle.corners_w = {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1),
                        Eigen::Vector3d(0, 1, 1)};  // counter-clockwise seen from above
  const ExactCaster caster(std::vector<Triangle>{triangle});
  const Eigen::Vector3d above(0.2, 0.3, 3), below(0.2, 0.3, -1), z = Eigen::Vector3d::UnitZ();
  const ExactHit front = caster.Nearest(above, -z, 0), back = caster.Nearest(below, z, 0);
  for (const ExactHit& hit : {front, back}) {
    EXPECT_EQ(hit.triangle, 0);
    EXPECT_NEAR(hit.distance, 2, 1e-12);
  }
  EXPECT_TRUE(front.from_front);
  EXPECT_FALSE(back.from_front);
  EXPECT_EQ(caster.Nearest({0.8, 0.8, 3}, -z, 0).triangle, -1);
  EXPECT_EQ(caster.Nearest(above, z, 0).triangle, -1);
}

}  // namespace
}  // namespace sim
