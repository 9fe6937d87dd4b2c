#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>

#include "property_tests/sim/render_worlds.h"
#include "sim/sensor/depth/depth_sensor.h"
#include "sim/trace/frame_renderer.h"

namespace sim {
namespace {

// The oracle's own rounding is 1e-15; the measured worst of triangles in single precision is
// 5e-6 z, of planes in double 1e-12 z. Only an id chosen wrongly at an edge may differ more.
RC_GTEST_PROP(RenderedDepth, EqualsTheAnalyticDepthOfBoxes, ()) {
  constexpr double kRelative = 1e-9;
  const Scene scene = AnyScene();
  const Camera camera = AnyCamera();
  const Pose T_wc = AnyView();
  const Rendering rendering = FrameRenderer(scene, camera).Render(T_wc, {.colour = false});
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const BoxHit hit = BoxAt(scene, camera, T_wc, u, v);
      const bool same = rendering.object_id(v, u) == hit.object &&
                        rendering.plane_id(v, u) == hit.plane &&
                        std::abs(rendering.depth_m(v, u) - hit.z) <= kRelative * hit.z;
      if (!same) RC_ASSERT(!FarFromEdges(scene, camera, T_wc, u, v));
    }
  }
}

/// Calls check(a, b, c) for the depths of each three neighbours of one plane, along rows and
/// columns.
template <typename Check>
void ForEachTriple(const cv::Mat1d& depth_m, const cv::Mat1w& ids, const Check& check) {
  for (const cv::Point step : {cv::Point(1, 0), cv::Point(0, 1)}) {
    for (int v = step.y; v + step.y < ids.rows; ++v) {
      for (int u = step.x; u + step.x < ids.cols; ++u) {
        const cv::Point at(u, v);
        if (ids(at) == 0 || ids(at - step) != ids(at) || ids(at + step) != ids(at)) continue;
        check(depth_m(at - step), depth_m(at), depth_m(at + step));
      }
    }
  }
}

double Bend(double a, double b, double c) { return std::abs(1 / a - 2 / b + 1 / c); }

RC_GTEST_PROP(RenderedDepth, IsAffineInInverseWithinAPlane, ()) {
  constexpr double kRelative = 1e-11;  // three products and a division in double, 1/z below 1e3
  const Rendering r =
      FrameRenderer(AnyScene(), AnyCamera()).Render(AnyView(), {.colour = false});
  ForEachTriple(r.depth_m, r.plane_id, [&](double a, double b, double c) {
    RC_ASSERT(b * Bend(a, b, c) <= kRelative);
  });
}

// Half a unit each, weights 1 + 2 + 1. The bound is reached, so it is tight.
RC_GTEST_PROP(RenderedDepth, RoundedToSixteenBitsBendsByTwoUnitsAtMost, ()) {
  constexpr double kUnit_m = 1.0 / 5000;
  const Rendering r =
      FrameRenderer(AnyScene(), AnyCamera()).Render(AnyView(), {.colour = false});
  cv::Mat1d rounded;
  EncodeDepth(r.depth_m, 5000).convertTo(rounded, CV_64F, kUnit_m);
  ForEachTriple(rounded, r.plane_id, [&](double a, double b, double c) {
    const double z = std::min({a, b, c});
    RC_ASSERT(Bend(a, b, c) <= 1.001 * 2 * kUnit_m / (z * z));
  });
}

/// Inverse depth between four pixels of one plane; 0 when they are not.
double InverseDepthAt(const Rendering& r, double u, double v, int plane, bool inverse) {
  const int u0 = static_cast<int>(std::floor(u)), v0 = static_cast<int>(std::floor(v));
  if (u0 < 0 || v0 < 0 || u0 + 1 >= r.depth_m.cols || v0 + 1 >= r.depth_m.rows) return 0;
  double sum = 0;
  for (int k = 0; k < 4; ++k) {
    const int x = u0 + (k & 1), y = v0 + (k >> 1);
    if (r.plane_id(y, x) != plane) return 0;
    const double weight =
        ((k & 1) != 0 ? u - u0 : u0 + 1 - u) * ((k >> 1) != 0 ? v - v0 : v0 + 1 - v);
    sum += weight * (inverse ? 1 / r.depth_m(y, x) : r.depth_m(y, x));
  }
  return inverse ? sum : 1 / sum;
}

/// Worst relative disagreement of view a, carried into view b, with view b.
double WorstWarp(const Rendering& a, const Pose& T_wa, const Rendering& b, const Pose& T_wb,
                 const Camera& camera, bool inverse) {
  const Pose T_ba = Inverse(T_wb) * T_wa;
  double worst = 0;
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      if (a.plane_id(v, u) == 0) continue;
      const Eigen::Vector3d x_b = T_ba * (a.depth_m(v, u) * camera.Ray(u, v));
      if (x_b.z() < 0.1) continue;
      const Eigen::Vector2d pixel = camera.Project(x_b);
      const double inverse_z =
          InverseDepthAt(b, pixel.x(), pixel.y(), a.plane_id(v, u), inverse);
      if (inverse_z > 0) worst = std::max(worst, std::abs(x_b.z() * inverse_z - 1));
    }
  }
  return worst;
}

RC_GTEST_PROP(RenderedDepth, AgreesBetweenTwoViews, ()) {
  constexpr double kRelative = 1e-10;
  const Camera camera = AnyCamera();
  const FrameRenderer renderer(AnyScene(), camera);
  const Pose T_wa = AnyView(), T_wb = AnyView();
  const Rendering a = renderer.Render(T_wa, {.colour = false});
  const Rendering b = renderer.Render(T_wb, {.colour = false});
  RC_ASSERT(WorstWarp(a, T_wa, b, T_wb, camera, true) < kRelative);
}

TEST(RenderedDepth, WouldNotAgreeIfItsValuesWereBlendedInsteadOfTheirInverses) {
  const Camera camera = SmallCamera();
  const FrameRenderer renderer(SmallDesk(), camera);
  const Pose T_wa = SmallArc(4)[0].T_wc, T_wb = SmallArc(4)[3].T_wc;
  const Rendering a = renderer.Render(T_wa), b = renderer.Render(T_wb);
  EXPECT_LT(WorstWarp(a, T_wa, b, T_wb, camera, true), 1e-10);
  EXPECT_GT(WorstWarp(a, T_wa, b, T_wb, camera, false), 1e-5);
}

}  // namespace
}  // namespace sim
