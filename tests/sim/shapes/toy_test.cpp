#include "sim/shapes/toy.h"

#include <gtest/gtest.h>

namespace sim {
namespace {

/// Mean distance between the vertices of two surfaces that were made alike.
double Apart_m(const ClosedSurface& a, const ClosedSurface& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.vertices_o.size(); ++i) {
    sum += (a.vertices_o[i] - b.vertices_o.at(i)).norm();
  }
  return sum / static_cast<double>(a.vertices_o.size());
}

TEST(ToyAndBush, HaveAShapeOfTheirOwnForEachSeed) {
  const Eigen::Vector3d size(0.2, 0.2, 0.3);
  for (const auto make : {&ToySurface, &BushSurface}) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      EXPECT_EQ(Apart_m(make(size, seed), make(size, seed)), 0.0) << seed;
      EXPECT_GT(Apart_m(make(size, seed), make(size, seed + 1)), 0.002) << seed;
    }
  }
}

}  // namespace
}  // namespace sim
