#include "sim/trace/edge_pixels.h"

#include <gtest/gtest.h>

#include <set>

#include "sim/trace/image_rays.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr double kMargin_px = 0.05;

/// Pixels whose centre is within the margin of a finely sampled line.
void AddNear(const Eigen::Vector3d& a_w, const Eigen::Vector3d& b_w, const Pose& T_wc,
             const Camera& camera, double margin_px, std::set<std::uint32_t>& pixels) {
  const Pose T_cw = Inverse(T_wc);
  constexpr int kSamples = 40000;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::Vector3d x_c = T_cw * (a_w + static_cast<double>(i) / kSamples * (b_w - a_w));
    if (x_c.z() < 0.01) continue;
    const Eigen::Vector2d at = camera.Project(x_c);
    const double u = std::round(at.x()), v = std::round(at.y());
    if (u < 0 || v < 0 || u >= camera.width || v >= camera.height) continue;
    if ((at - Eigen::Vector2d(u, v)).norm() > margin_px) continue;
    pixels.insert(static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(camera.width) +
                  static_cast<std::uint32_t>(u));
  }
}

void ExpectEveryNearPixelListed(const Camera& camera) {
  Scene scene;
  scene.objects = {BoxObject(1, "desk", Role::kStructure, {0.05, 1.0, -0.2}, {3.0, 2.5, 0.02}),
                   BoxObject(2, "book", Role::kRegular, {0.1, 0.9, 0.05}, {0.3, 0.2, 0.25})};
  scene.objects[1].q_wo = Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 3).normalized());
  const std::vector<Triangle> triangles = BuildMesh(scene).triangles;
  const Pose T_wc = LookAlongY();
  std::set<std::uint32_t> expected, listed;
  for (const Triangle& triangle : triangles) {
    const Eigen::Vector3d &a = triangle.corners_w[0], &b = triangle.corners_w[1],
                          &c = triangle.corners_w[2];
    // The diagonal, which gets a fifth of the margin, is the longest side.
    const auto margin = [&](double side) {
      const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
      return side == longest ? 0.2 * kMargin_px : kMargin_px;
    };
    AddNear(a, b, T_wc, camera, 0.98 * margin((b - a).norm()), expected);
    AddNear(b, c, T_wc, camera, 0.98 * margin((c - b).norm()), expected);
    AddNear(c, a, T_wc, camera, 0.98 * margin((a - c).norm()), expected);
  }
  std::vector<EdgePixel> pixels;
  SceneEdges(triangles).Near(T_wc, camera, ImageRays(camera).Window(), kMargin_px, pixels);
  for (const EdgePixel& edge : pixels) listed.insert(edge.pixel);
  ASSERT_GT(expected.size(), 100u);
  for (const std::uint32_t pixel : expected) EXPECT_TRUE(listed.contains(pixel)) << pixel;
  EXPECT_LT(listed.size(), 2 * expected.size());
}

TEST(PixelsNearEdges, AreAllFound) { ExpectEveryNearPixelListed(Camera{}); }

// A straight line from end to end of an edge misses the bent one by many pixels.
TEST(PixelsNearEdges, AreAllFoundBehindALens) {
  ExpectEveryNearPixelListed(WithLens(Camera{}, {-0.2, 0.05, 0.002, -0.001, 0.0}));
}

}  // namespace
}  // namespace sim
