#include "slam/faces/edge_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace slam {
namespace {

/// Points every 2 px along a segment.
void AddSegment(std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& a,
                const Eigen::Vector2d& b) {
  const int n = static_cast<int>((b - a).norm() / 2.0);
  for (int k = 0; k < n; ++k) points.push_back(a + (b - a) * k / n);
}

std::vector<Eigen::Vector2d> Rectangle() {
  std::vector<Eigen::Vector2d> points;
  const Eigen::Vector2d c[4] = {{100, 100}, {220, 120}, {205, 210}, {85, 190}};
  for (int k = 0; k < 4; ++k) AddSegment(points, c[k], c[(k + 1) % 4]);
  return points;
}

TEST(EdgeLines, FindTheFourSidesOfARectangle) {
  const auto lines = FindImageLines(Rectangle(), 8, {}, Random{1});
  ASSERT_EQ(lines.size(), 4u);
  for (const ImageLine& line : lines) EXPECT_GT((line.to - line.from).norm(), 80.0);
}

TEST(EdgeLines, DoNotDependOnTheOrderOfThePoints) {
  std::vector<Eigen::Vector2d> points = Rectangle();
  const auto before = FindImageLines(points, 8, {}, Random{1});
  std::rotate(points.begin(), points.begin() + 37, points.end());
  std::reverse(points.begin() + 5, points.begin() + 90);
  const auto after = FindImageLines(points, 8, {}, Random{1});
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(before[k].p, after[k].p);
    EXPECT_EQ(before[k].v, after[k].v);
  }
}

TEST(EdgeLines, DoNotBridgeAGap) {
  std::vector<Eigen::Vector2d> points;
  AddSegment(points, {0, 50}, {80, 50});
  AddSegment(points, {160, 50}, {200, 50});
  const auto lines = FindImageLines(points, 8, {}, Random{1});
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_NEAR((lines[0].to - lines[0].from).norm(), 78.0, 2.0);
  EXPECT_NEAR((lines[1].to - lines[1].from).norm(), 38.0, 2.0);
}

// The longest are found first, so a cap leaves out the short ones; what is found comes by its support.
TEST(EdgeLines, AreTheLongestAsManyAsAreAskedFor) {
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 8; ++k) AddSegment(points, {0, 40.0 * k}, {40.0 + 20.0 * k, 40.0 * k});
  for (const int cap : {3, 6}) {
    EdgeLineConfig config;
    config.max_lines = cap;
    const auto lines = FindImageLines(points, 8, config, Random{1});
    ASSERT_EQ(static_cast<int>(lines.size()), cap);
    for (int k = 0; k < cap; ++k) {
      const ImageLine& line = lines[static_cast<std::size_t>(k)];
      EXPECT_NEAR(line.p.y(), 40.0 * (7 - k), 1e-9) << k;
    }
  }
}

TEST(EdgeLines, FindNoneInTooFewPoints) {
  EXPECT_TRUE(FindImageLines({}, 4, {}, Random{1}).empty());
  EXPECT_TRUE(FindImageLines({{1, 1}}, 4, {}, Random{1}).empty());
  EXPECT_TRUE(FindImageLines({{1, 1}, {1, 1}, {1, 1}, {1, 1}}, 4, {}, Random{1}).empty());
}

TEST(EdgeLines, LieOnThePlaneAndUseOnlyTheSurfacesOwnEdges) {
  const Camera camera;
  FramePlane plane;
  plane.pi_c = {Eigen::Vector3d(0, -0.6, -0.8), 0.8};
  plane.centroid_c = {0, 0, 1};
  const auto add = [&](const Eigen::Vector2d& u, EdgeKind kind) {
    const Eigen::Vector3d ray = camera.Backproject(u, 1.0);
    plane.edge_points.push_back({ray * (-plane.pi_c.d / plane.pi_c.n.dot(ray)), u, kind});
  };
  for (int k = 0; k < 60; ++k) add(Eigen::Vector2d(280 + k, 200), EdgeKind::kSurface);
  for (int k = 0; k < 60; ++k) add(Eigen::Vector2d(280 + k, 300), EdgeKind::kOccluded);
  const auto lines = FindEdgeLines(plane, camera, {}, Random{1});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NEAR(SignedDistance(plane.pi_c, lines[0].line_c.P), 0.0, 1e-12);
  EXPECT_NEAR(plane.pi_c.n.dot(lines[0].line_c.V), 0.0, 1e-9);
  EXPECT_NEAR(lines[0].line_c.V.norm(), 1.0, 1e-12);
  // Half a pixel outwards: up, away from the centroid at v = 239.5.
  EXPECT_NEAR(lines[0].from_px.y(), 199.5, 1e-9);
}

// Straight things are recorded as curves.
TEST(EdgeLines, AreStraightHoweverTheLensBendsThem) {
  Camera camera;
  camera.k1 = -0.25;
  FramePlane plane;
  plane.pi_c = {Eigen::Vector3d(0, -0.6, -0.8), 0.8};
  plane.centroid_c = {0, 0, 1};
  // A side near the image's upper border, 10 px off its chord in the recorded image.
  const auto on_plane = [&](const Eigen::Vector2d& u_px) {
    const Eigen::Vector3d ray = camera.Backproject(u_px, 1.0);
    return Eigen::Vector3d(ray * (-plane.pi_c.d / plane.pi_c.n.dot(ray)));
  };
  for (int k = 0; k <= 120; ++k) {
    const Eigen::Vector3d p_c = on_plane({20.0 + 5 * k, 25.0});
    plane.edge_points.push_back({p_c, camera.ProjectDistorted(p_c), EdgeKind::kSurface});
  }
  const auto lines = FindEdgeLines(plane, camera, {}, Random{1});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].support, 121);
  EXPECT_LT((lines[0].to_px - lines[0].from_px).cwiseAbs().y(), 1e-6);
  EXPECT_NEAR(lines[0].from_px.y(), 24.5, 1e-6);  // half a pixel outwards
  const Eigen::Vector3d along = (on_plane({620, 24.5}) - on_plane({20, 24.5})).normalized();
  EXPECT_NEAR(std::abs(lines[0].line_c.V.dot(along)), 1.0, 1e-9);
}

TEST(EdgeLines, AreDoubtfulWhicheverWayTheyRun) {
  const Camera camera;
  int found = 0;
  for (double angle_deg = 0; angle_deg < 360; angle_deg += 0.5) {
    const double a = angle_deg * M_PI / 180;
    const Eigen::Vector2d along(std::cos(a), std::sin(a));
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 1.0};
    plane.centroid_c = {0, 0, 1};
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector2d u =
          Eigen::Vector2d(320, 240) + (2 * k - 60) * along +
          std::sin(7.0 * k) * 0.4 * Eigen::Vector2d(-along.y(), along.x());
      plane.edge_points.push_back({camera.Backproject(u, 1.0), u, EdgeKind::kSurface, 3});
    }
    for (const EdgeLine& line : FindEdgeLines(plane, camera, {}, Random{1})) {
      const Eigen::Vector2d middle = (line.from_px + line.to_px) / 2;
      EXPECT_GT(std::sqrt(line.error.Variance(middle)), 1) << angle_deg;
      ++found;
    }
  }
  EXPECT_GT(found, 0);
}

TEST(EdgeLines, AreDoubtfulAsAWholeWhereDepthHardlyChangesAcrossThem) {
  const Camera camera;
  const auto sigma_px = [&](float step_sigmas) {
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 1.0};
    plane.centroid_c = {0, 0, 1};
    for (int k = 0; k < 60; ++k) {
      const Eigen::Vector2d u(280 + k, 200);
      plane.edge_points.push_back(
          {camera.Backproject(u, 1.0), u, EdgeKind::kSurface, step_sigmas});
    }
    const auto lines = FindEdgeLines(plane, camera, {}, Random{1});
    return std::sqrt(lines.at(0).error.Variance(lines.at(0).from_px));
  };
  const double unknown_px = sigma_px(0), clear_px = sigma_px(1000), thin_px = sigma_px(5);
  EXPECT_NEAR(clear_px, unknown_px, 1e-3);
  EXPECT_NEAR(thin_px * thin_px - clear_px * clear_px, std::pow(4.0 / 5, 4), 0.01);
  EXPECT_LT(sigma_px(20), thin_px);
}

TEST(EdgeLines, AreNotAsDoubtfulAsAnotherPieceOfTheSameSide) {
  const Camera camera;
  constexpr float kClear = 1000, kThin = 4;
  // A side in two pieces, 280 to 339 and 380 to 439; a step of 0: not there.
  const auto find = [&](float step_left, float step_right) {
    FramePlane plane;
    plane.pi_c = {Eigen::Vector3d(0, 0, -1), 1.0};
    plane.centroid_c = {0, 0, 1};
    for (int k = 0; k < 120; ++k) {
      const Eigen::Vector2d u(k < 60 ? 280 + k : 320 + k, 200);
      const float step = k < 60 ? step_left : step_right;
      if (step > 0)
        plane.edge_points.push_back({camera.Backproject(u, 1.0), u, EdgeKind::kSurface, step});
    }
    auto lines = FindEdgeLines(plane, camera, {}, Random{1});
    std::sort(lines.begin(), lines.end(), [](const EdgeLine& a, const EdgeLine& b) {
      return a.from_px.x() + a.to_px.x() < b.from_px.x() + b.to_px.x();
    });
    return lines;
  };
  const auto variance = [](const EdgeLine& line) { return line.error.Variance(line.from_px); };
  for (const bool left_is_thin : {true, false}) {
    const float left = left_is_thin ? kThin : kClear, right = left_is_thin ? kClear : kThin;
    const auto both = find(left, right), left_alone = find(left, 0),
               right_alone = find(0, right);
    ASSERT_EQ(both.size(), 2u);
    ASSERT_EQ(left_alone.size(), 1u);
    ASSERT_EQ(right_alone.size(), 1u);
    EXPECT_NEAR(variance(both[0]), variance(left_alone[0]), 1e-9) << left_is_thin;
    EXPECT_NEAR(variance(both[1]), variance(right_alone[0]), 1e-9) << left_is_thin;
    EXPECT_GT(std::abs(variance(both[0]) - variance(both[1])), 0.9);  // that of a pixel
  }
}

}  // namespace
}  // namespace slam
