#include "sim/models/loops.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace sim {
namespace {

using Eigen::Vector3d;
using Polygon = std::vector<Vector3d>;

/// A polygon that turns left about +z once, with dents, in the plane z = 2.
Polygon Star(unsigned seed, int corners) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> radius(0.3, 1.0);
  Polygon star;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = radius(random);
    star.emplace_back(5 + r * std::cos(angle), -3 + r * std::sin(angle), 2);
  }
  return star;
}

double DistanceToSegment(const Vector3d& x, const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double t = std::clamp((x - a).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (x - a - t * way).norm();
}

double DistanceToLoop(const Vector3d& x, const Polygon& loop) {
  double least = 1e9;
  for (std::size_t i = 0; i < loop.size(); ++i)
    least = std::min(least, DistanceToSegment(x, loop[i], loop[(i + 1) % loop.size()]));
  return least;
}

TEST(TwiceArea, IsThatOfTheShoelaceFormula) {
  const Polygon triangle{{0, 0, 1}, {3, 0, 1}, {0, 2, 1}};
  EXPECT_TRUE(TwiceArea(triangle).isApprox(Vector3d(0, 0, 6), 1e-12));
  EXPECT_TRUE(TwiceArea({triangle.rbegin(), triangle.rend()}).isApprox(Vector3d(0, 0, -6)));
}

TEST(Triangulated, CoversADentedPolygonOnceWithTrianglesThatTurnAsItDoes) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Polygon star = Star(seed, 3 + static_cast<int>(seed) / 2);
    const auto triangles = Triangulated(star);
    ASSERT_EQ(triangles.size(), star.size() - 2);
    double area = 0;
    for (const auto& [a, b, c] : triangles) {
      const double part = TwiceArea({star[a], star[b], star[c]}).z();
      EXPECT_GE(part, -1e-12);
      area += part;
    }
    EXPECT_NEAR(area, TwiceArea(star).z(), 1e-9);
  }
}

TEST(Simplified, LeavesOutNothingThatLiesBesideWhatIsLeft) {
  constexpr double kTolerance = 0.05;
  int left_out = 0;
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Polygon star = Star(seed, 60);
    const Polygon simple = Simplified(star, kTolerance);
    for (const Vector3d& x : star) EXPECT_LE(DistanceToLoop(x, simple), kTolerance + 1e-12);
    left_out += static_cast<int>(star.size() - simple.size());
  }
  EXPECT_GT(left_out, 30);
}

// Whatever corner the loop begins with.
TEST(Simplified, LeavesTheCornersOfASquareAlone) {
  Polygon square;
  for (int i = 0; i < 40; ++i) {
    const double t = (i % 10) / 10.0;
    const Vector3d corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    square.push_back((1 - t) * corners[i / 10] + t * corners[i / 10 + 1]);
  }
  for (int first = 0; first < 40; ++first) {
    std::rotate(square.begin(), square.begin() + 1, square.end());
    const Polygon simple = Simplified(square, 1e-6);
    ASSERT_EQ(simple.size(), 4u) << first;
    EXPECT_NEAR(TwiceArea(simple).z(), 2.0, 1e-12);
  }
}

TEST(Loops, KeepsSquaresApartThatMeetInAVertex) {
  const Polygon vertices{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                         {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  const auto loops = Loops({{0, 1}, {1, 2}, {2, 3}, {3, 0}, {2, 4}, {4, 5}, {5, 6}, {6, 2}},
                           vertices, Vector3d::UnitZ());
  ASSERT_EQ(loops.size(), 2u);
  for (const Polygon& loop : loops) {
    EXPECT_EQ(loop.size(), 4u);
    EXPECT_NEAR(TwiceArea(loop).z(), 2.0, 1e-12);
  }
}

// How far the way turns at a vertex goes by the edge that led to it, not by where it began.
TEST(Loops, TurnsLeftOfTheEdgeThatLedToTheVertex) {
  const Polygon vertices{{0, 3, 0},   {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0.5, 1, 0},
                         {0.5, 3, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}};
  const auto loops =
      Loops({{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 0}, {3, 6}, {6, 7}, {7, 8}, {8, 3}},
            vertices, Vector3d::UnitZ());
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 6u);
  EXPECT_EQ(loops[1].size(), 4u);
}

}  // namespace
}  // namespace sim
