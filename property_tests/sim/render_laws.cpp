#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>

#include "property_tests/sim/render_worlds.h"
#include "sim/trace/frame_renderer.h"

namespace sim {
namespace {

/// Same pixels, bit for bit.
bool Same(const cv::Mat& a, const cv::Mat& b) {
  if (a.size() != b.size() || a.type() != b.type()) return false;
  for (int v = 0; v < a.rows; ++v) {
    if (std::memcmp(a.ptr(v), b.ptr(v), a.elemSize() * static_cast<std::size_t>(a.cols)) != 0) {
      return false;
    }
  }
  return true;
}

/// Whether the ray's answer is the same a hundredth of a pixel to every side.
bool FarFromEdges(const Scene& scene, const Camera& camera, const Pose& T_wc, int u, int v,
                  int object) {
  for (const auto& [du, dv] : {std::pair{0.01, 0.0}, {-0.01, 0.0}, {0.0, 0.01}, {0.0, -0.01}}) {
    const auto hit = CastAtBoxes(scene, T_wc.t, T_wc.R * camera.Ray(u + du, v + dv));
    if ((hit ? hit->object : 0) != object) return false;
  }
  return true;
}

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
      const auto hit = CastAtBoxes(scene, T_wc.t, T_wc.R * camera.Ray(u, v));
      const int object = hit ? hit->object : 0;
      const double z = hit ? hit->z : 0.0;
      const bool same = rendering.object_id(v, u) == object &&
                        std::abs(rendering.depth_m(v, u) - z) <= kRelative * z;
      if (!same) RC_ASSERT(!FarFromEdges(scene, camera, T_wc, u, v, object));
    }
  }
}

RC_GTEST_PROP(RenderedDepth, IsAffineInInverseWithinAPlane, ()) {
  constexpr double kRelative = 1e-11;  // three products and a division in double, 1/z below 1e3
  const Rendering r =
      FrameRenderer(AnyScene(), AnyCamera()).Render(AnyView(), {.colour = false});
  for (int v = 0; v < r.depth_m.rows; ++v) {
    for (int u = 2; u < r.depth_m.cols; ++u) {
      const int id = r.plane_id(v, u);
      if (id == 0 || r.plane_id(v, u - 1) != id || r.plane_id(v, u - 2) != id) continue;
      const double bend =
          1 / r.depth_m(v, u) - 2 / r.depth_m(v, u - 1) + 1 / r.depth_m(v, u - 2);
      RC_ASSERT(r.depth_m(v, u - 1) * std::abs(bend) <= kRelative);
    }
  }
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

/// Cuts a polygon at a x + b y <= c.
std::vector<Eigen::Vector2d> Cut(const std::vector<Eigen::Vector2d>& polygon,
                                 const Eigen::Vector2d& ab, double c) {
  std::vector<Eigen::Vector2d> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double dp = ab.dot(p) - c, dq = ab.dot(q) - c;
    if (dp <= 0) kept.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
      kept.push_back(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

// A pixel centre lies inside or not: the count misses the area by a small share of the outline.
RC_GTEST_PROP(RenderedMask, HasTheAreaOfTheProjectedPolygon, ()) {
  Scene scene;
  scene.objects = {BoxObject(1, "book", Role::kRegular,
                             {Real(-0.3, 0.3), Real(1.2, 3), Real(-0.3, 0.3)},
                             {Real(0.2, 0.8), 0.02, Real(0.2, 0.8)})};
  const double turn = Real(-1.4, 1.4);  // 80 deg either way
  scene.objects[0].q_wo = Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
  const Camera camera = SmallCamera();
  const Rendering r = FrameRenderer(scene, camera).Render(LookAlongY(), {.colour = false});
  for (const ScenePlane& plane : ScenePlanes(scene)) {
    if (plane.face != Face::kMinusY || !(plane.d > 0.05))
      continue;  // the camera sees its front
    std::vector<Eigen::Vector2d> polygon;
    for (const auto& x_w : plane.vertices_w) {
      polygon.push_back(camera.Project(Inverse(LookAlongY()) * x_w));
    }
    polygon = Cut(polygon, {1, 0}, 159.5);
    polygon = Cut(polygon, {-1, 0}, 0.5);
    polygon = Cut(polygon, {0, 1}, 119.5);
    polygon = Cut(polygon, {0, -1}, 0.5);
    double area = 0, outline = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      area += 0.5 * (p.x() * q.y() - p.y() * q.x());
      outline += (q - p).norm();
    }
    const int pixels = cv::countNonZero(r.plane_id == plane.id);
    // Edges along the pixel grid can lose or win half a pixel all along.
    RC_ASSERT(std::abs(pixels - std::abs(area)) <= 0.5 * outline + 4);
  }
}

RC_GTEST_PROP(RenderedFrame, OfAShiftedPrincipalPointIsTheSameFrameCropped, ()) {
  const Scene scene = AnyScene();
  const Pose T_wc = AnyView();
  const Camera camera = SmallCamera();
  const int du = *rc::gen::inRange(0, 60), dv = *rc::gen::inRange(0, 40);
  Camera crop = camera;
  crop.width -= du;
  crop.height -= dv;
  crop.cx -= du;
  crop.cy -= dv;
  const cv::Rect window(du, dv, crop.width, crop.height);
  const Rendering whole = FrameRenderer(scene, camera).Render(T_wc, {.colour = false});
  const Rendering part = FrameRenderer(scene, crop).Render(T_wc, {.colour = false});
  RC_ASSERT(Same(part.depth_m, whole.depth_m(window)));
  RC_ASSERT(Same(part.plane_id, whole.plane_id(window)));
  RC_ASSERT(Same(part.object_id, whole.object_id(window)));
}

RC_GTEST_PROP(RenderedFrame, IgnoresAnObjectThatIsWhollyHidden, ()) {
  Scene scene = AnyScene();
  const Pose T_wc = AnyView();
  scene.objects.push_back(BoxObject(40, "wall", Role::kStructure, {0, 9, 0}, {60, 0.5, 60}));
  const Rendering before = FrameRenderer(scene, SmallCamera()).Render(T_wc, {.colour = false});
  scene.objects.push_back(BoxObject(41, "box", Role::kRegular,
                                    {Real(-3, 3), Real(11, 12), Real(-3, 3)}, {0.5, 0.5, 0.5}));
  const Rendering after = FrameRenderer(scene, SmallCamera()).Render(T_wc, {.colour = false});
  RC_ASSERT(Same(before.depth_m, after.depth_m));
  RC_ASSERT(Same(before.plane_id, after.plane_id));
}

RC_GTEST_PROP(RenderedFrame, DoesNotDependOnTheOrderOfObjects, ()) {
  const Scene scene = AnyScene();
  Scene turned = scene;
  const auto first = *rc::gen::inRange<std::size_t>(0, scene.objects.size());
  std::rotate(turned.objects.begin(),
              turned.objects.begin() + static_cast<std::ptrdiff_t>(first),
              turned.objects.end());
  const Pose T_wc = AnyView();
  const Rendering a = FrameRenderer(scene, SmallCamera()).Render(T_wc);
  const Rendering b = FrameRenderer(turned, SmallCamera()).Render(T_wc);
  RC_ASSERT(Same(a.object_id, b.object_id));
  RC_ASSERT(Same(a.depth_m, b.depth_m));
  RC_ASSERT(Same(a.radiance, b.radiance));
}

RC_GTEST_PROP(RenderedFrame, DoesNotDependOnTheFramesBeforeIt, ()) {
  const Scene scene = AnyScene();
  const Pose T_wa = AnyView(), T_wb = AnyView();
  const FrameRenderer one(scene, SmallCamera()), other(scene, SmallCamera());
  one.Render(T_wa);
  RC_ASSERT(Same(one.Render(T_wb).radiance, other.Render(T_wb).radiance));
}

}  // namespace
}  // namespace sim
