// What must not change, or only in a known way, when the question is put differently.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <opencv2/core.hpp>
#include <thread>

#include "property_tests/sim/render_worlds.h"
#include "sim/trace/frame_renderer.h"

namespace sim {
namespace {

Rendering RenderShape(const Scene& scene, const Camera& camera, const Pose& T_wc) {
  return FrameRenderer(scene, camera).Render(T_wc, {.colour = false});
}

bool SameShape(const Rendering& a, const Rendering& b) {
  return Same(a.depth_m, b.depth_m) && Same(a.plane_id, b.plane_id) &&
         Same(a.object_id, b.object_id);
}

Scene Moved(Scene scene, const Pose& T_nw, double scale = 1) {
  for (Object& object : scene.objects) {
    object.center_w = scale * (T_nw * object.center_w);
    object.q_wo = Eigen::Quaterniond(T_nw.R) * object.q_wo;
    object.size *= scale;
  }
  return scene;
}

// In single precision the world's origin shows: by an ulp of the distance to it, 8e-6 m at
// 100 m, which is where a scene file ends. That is 2e-3 px here, and moves edges alone.
RC_GTEST_PROP(RenderedFrame, MovesWithSceneAndCameraTogether, ()) {
  const Scene scene = AnyScene();
  const Camera camera = AnyCamera();
  const Pose T_wc = AnyView();
  Pose T_nw;
  T_nw.R = AnyRotation().toRotationMatrix();
  const double far_m = AnyInt(0, 3) == 0 ? 90 : 5;
  T_nw.t = {Real(-far_m, far_m), Real(-far_m, far_m), Real(-far_m, far_m)};
  const Rendering before = RenderShape(scene, camera, T_wc);
  const Rendering after = RenderShape(Moved(scene, T_nw), camera, T_nw * T_wc);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const double z = before.depth_m(v, u);
      const bool same = after.plane_id(v, u) == before.plane_id(v, u) &&
                        std::abs(after.depth_m(v, u) - z) <= 2e-5 * z;
      if (!same) RC_ASSERT(!FarFromEdges(scene, camera, T_wc, u, v));
    }
  }
}

RC_GTEST_PROP(RenderedFrame, ScalesBitForBitByPowersOfTwo, ()) {
  const Scene scene = AnyScene();
  const Camera camera = AnyCamera();
  const Pose T_wc = AnyView();
  const double scale = std::ldexp(1.0, AnyInt(0, 1) == 0 ? AnyInt(-4, -1) : AnyInt(1, 4));
  const Rendering before = RenderShape(scene, camera, T_wc);
  const Rendering after =
      RenderShape(Moved(scene, Pose{}, scale), camera, Pose{T_wc.R, scale * T_wc.t});
  RC_ASSERT(Same(after.plane_id, before.plane_id));
  RC_ASSERT(Same(after.object_id, before.object_id));
  RC_ASSERT(Same(after.depth_m, before.depth_m * scale));
}

RC_GTEST_PROP(RenderedFrame, OfAShiftedPrincipalPointIsTheSameFrameCropped, ()) {
  const Scene scene = AnyScene();
  const Pose T_wc = AnyView();
  const Camera camera = SmallCamera();
  const int du = AnyInt(0, 60), dv = AnyInt(0, 40);
  Camera crop = camera;
  crop.width -= du;
  crop.height -= dv;
  crop.cx -= du;
  crop.cy -= dv;
  const cv::Rect window(du, dv, crop.width, crop.height);
  const Rendering whole = RenderShape(scene, camera, T_wc);
  const Rendering part = RenderShape(scene, crop, T_wc);
  RC_ASSERT(Same(part.depth_m, whole.depth_m(window)));
  RC_ASSERT(Same(part.plane_id, whole.plane_id(window)));
  RC_ASSERT(Same(part.object_id, whole.object_id(window)));
}

RC_GTEST_PROP(RenderedFrame, IgnoresAnObjectThatIsWhollyHidden, ()) {
  Scene scene = AnyScene();
  const Pose T_wc = AnyView();
  scene.objects.push_back(BoxObject(50, "wall", Role::kStructure, {0, 12, 0}, {80, 0.5, 80}));
  const Rendering before = RenderShape(scene, SmallCamera(), T_wc);
  scene.objects.push_back(BoxObject(51, "box", Role::kRegular,
                                    {Real(-3, 3), Real(14, 15), Real(-3, 3)}, {0.5, 0.5, 0.5}));
  RC_ASSERT(SameShape(before, RenderShape(scene, SmallCamera(), T_wc)));
}

/// Plain things but for one printed face: baking prints takes its time.
Scene SparselyPrinted() {
  Scene scene = AnyScene(5);
  std::erase_if(scene.objects,
                [](const Object& object) { return object.class_name == "wall"; });
  for (Object& object : scene.objects) {
    for (Material& face : object.faces) face.print = Print::kPlain;
  }
  scene.objects[0].size = scene.objects[0].size.cwiseMin(0.4);
  scene.objects[0].faces[2].print = Print::kSpeckle;
  return scene;
}

RC_GTEST_PROP(RenderedFrame, DoesNotDependOnTheOrderOfObjects, ()) {
  const Scene scene = SparselyPrinted();
  const std::size_t count = scene.objects.size(),
                    first = static_cast<std::size_t>(AnyInt(0, static_cast<int>(count) - 1));
  Scene turned = scene;
  std::rotate(turned.objects.begin(),
              turned.objects.begin() + static_cast<std::ptrdiff_t>(first),
              turned.objects.end());
  const Pose T_wc = AnyView();
  const Rendering a = FrameRenderer(scene, SmallCamera()).Render(T_wc);
  const Rendering b = FrameRenderer(turned, SmallCamera()).Render(T_wc);
  RC_ASSERT(Same(a.object_id, b.object_id));
  RC_ASSERT(Same(a.depth_m, b.depth_m));
  RC_ASSERT(Same(a.radiance, b.radiance));
  cv::Mat1w relabelled = b.plane_id.clone();  // planes are counted through the list
  for (ushort& id : relabelled) {
    if (id == 0) continue;
    const std::size_t place = static_cast<std::size_t>(id - 1) / 6;
    id = static_cast<ushort>(6 * ((place + first) % count) + (id - 1) % 6u + 1);
  }
  RC_ASSERT(Same(a.plane_id, relabelled));
}

RC_GTEST_PROP(RenderedFrame, DoesNotDependOnTheFramesBeforeIt, ()) {
  const Scene scene = SparselyPrinted();
  const Pose T_wa = AnyView(), T_wb = AnyView();
  const FrameRenderer one(scene, SmallCamera()), other(scene, SmallCamera());
  one.Render(T_wa);
  RC_ASSERT(Same(one.Render(T_wb).radiance, other.Render(T_wb).radiance));
}

RC_GTEST_PROP(RenderedFrame, IsTheSameWhenThreadsRenderOthersMeanwhile, ()) {
  const FrameRenderer renderer(SparselyPrinted(), SmallCamera());
  const std::vector<Pose> views{AnyView(), AnyView(), AnyView()};
  std::vector<Rendering> alone, together(views.size());
  for (const Pose& T_wc : views) alone.push_back(renderer.Render(T_wc));
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < views.size(); ++i) {
    threads.emplace_back([&, i] { together[i] = renderer.Render(views[i]); });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < views.size(); ++i) {
    RC_ASSERT(SameShape(together[i], alone[i]));
    RC_ASSERT(Same(together[i].radiance, alone[i].radiance));
  }
}

}  // namespace
}  // namespace sim
