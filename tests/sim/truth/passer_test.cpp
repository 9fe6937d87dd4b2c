#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/scene/geometry.h"
#include "sim/truth/frame_truth.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// A cube of 0.2 that crosses the view from left to right in a second, its front 0.9 m away.
Scene CrossingCube() {
  Scene scene = OneBoard(2.0);
  Object cube = BoxObject(2, "box", Role::kUnstructured, {-0.5, 1, 0}, {0.2, 0.2, 0.2});
  cube.way = {{0, {-0.5, 1, 0}, 0}, {1, {0.5, 1, 0}, 0}};
  scene.objects.push_back(cube);
  return scene;
}

TEST(WhatMoves, IsWhereItsWaySaysAtTheMomentOfTheView) {
  const Camera camera = SmallCamera();
  const FrameRenderer renderer(CrossingCube(), camera);
  RenderOptions options;
  for (const double time_s : {0.25, 0.5, 0.625}) {
    options.time_s = time_s;
    const Rendering seen = renderer.Render(LookAlongY(), options);
    const double left = camera.fx * (time_s - 0.6) / 0.9 + camera.cx;
    const double right = camera.fx * (time_s - 0.4) / 0.9 + camera.cx;
    const int v = 60;
    for (int u = 0; u < camera.width; ++u) {
      // Beyond its front the cube shows a side.
      if (u > left && u < right) {
        ASSERT_NEAR(seen.depth_m(v, u), 0.9, 1e-12) << time_s << " " << u;
        ASSERT_EQ(seen.object_id(v, u), 2) << time_s << " " << u;
        ASSERT_EQ(seen.plane_id(v, u), 0) << "it has no plane that stays";
      } else if (u < left - 6 || u > right + 6) {
        ASSERT_NEAR(seen.depth_m(v, u), 2.0, 1e-12) << time_s << " " << u;
        ASSERT_EQ(seen.object_id(v, u), 1);
        ASSERT_GT(seen.plane_id(v, u), 0);
      }
    }
  }
}

/// The desk with a toy that turns on its way, and the same frozen at a moment.
struct TwoDesks {
  Scene moving = SmallDesk(), frozen = SmallDesk();
  explicit TwoDesks(double time_s) {
    Object& toy = moving.objects[6];
    toy.size = {0.2, 0.2, 0.25};
    toy.way = {
        {0, {0.5, 0.2, 0.95}, 20}, {1, {-0.1, -0.3, 1.0}, 130}, {2, {-0.6, 0, 0.9}, 260}};
    toy.center_w = toy.way[0].center_w;
    for (Material& face : toy.faces) face.infrared = 0.05;  // no other thing has so little
    frozen.objects[6] = ObjectAt(toy, time_s);
  }
};

TEST(WhatMoves, LooksAsIfItStoodThere) {
  const Camera camera = SmallCamera();
  const Pose T_wc = LookAt({0.2, -1.1, 1.5}, {0, 0, 0.8});
  for (const double time_s : {0.5, 1.3}) {
    const TwoDesks desks(time_s);
    RenderOptions options;
    options.projector_offset_m = 0.075;
    const Rendering frozen = FrameRenderer(desks.frozen, camera).Render(T_wc, options);
    options.time_s = time_s;
    const Rendering moving = FrameRenderer(desks.moving, camera).Render(T_wc, options);
    int ids = 0, own = 0, lit = 0, dark = 0, infrared = 0, colour = 0;
    double depth_m = 0, on_outline = 0;
    const auto outline = [&](int v, int u) {
      for (const auto& [dv, du] : {std::pair(0, 1), {0, -1}, {1, 0}, {-1, 0}}) {
        const int y = std::clamp(v + dv, 0, camera.height - 1);
        const int x = std::clamp(u + du, 0, camera.width - 1);
        if ((frozen.object_id(y, x) == 7) != (frozen.object_id(v, u) == 7)) return true;
      }
      return false;
    };
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        own += frozen.object_id(v, u) == 7;
        dark += frozen.projector_lit(v, u) == 0;
        infrared += frozen.infrared(v, u) != moving.infrared(v, u);
        lit += frozen.projector_lit(v, u) != moving.projector_lit(v, u);
        const double off = cv::norm(frozen.radiance(v, u) - moving.radiance(v, u));
        if (outline(v, u)) {
          on_outline = std::max(on_outline, off);
        } else {
          colour += off > 0.02;
        }
        if (frozen.object_id(v, u) != moving.object_id(v, u)) {
          ++ids;
        } else {
          ASSERT_EQ(frozen.plane_id(v, u), moving.plane_id(v, u));
          depth_m = std::max(depth_m, std::abs(frozen.depth_m(v, u) - moving.depth_m(v, u)));
        }
      }
    }
    EXPECT_GT(own, 300);
    EXPECT_GT(dark, 100);
    EXPECT_LE(ids, 2) << "of pixels on its outline";
    EXPECT_LE(infrared, ids);
    EXPECT_LT(depth_m, 1e-9);
    // Shadows, of it and on it, are cast in single precision from another frame.
    EXPECT_LE(lit, 12);
    EXPECT_LE(colour, 12);
    // There the print behind it is that of the whole pixel, not of the rays that missed it.
    EXPECT_LT(on_outline, 0.25) << "sky would shine through with 0.5";
  }
}

TEST(WhatMoves, HidesWhatItWouldHideIfItStoodThere) {
  const Camera camera = SmallCamera();
  const Pose T_wc = LookAt({0.2, -1.1, 1.5}, {0, 0, 0.8});
  for (const double time_s : {0.5, 0.8, 1.3}) {
    const TwoDesks desks(time_s);
    const FrameRenderer moving(desks.moving, camera), frozen(desks.frozen, camera);
    int hidden = 0;
    for (double x = -0.7; x < 0.7; x += 0.05) {
      for (double y = -0.4; y < 0.6; y += 0.05) {
        const bool seen = frozen.Sees(T_wc, {x, y, 0.751}, 0.0);
        EXPECT_EQ(moving.Sees(T_wc, {x, y, 0.751}, time_s), seen) << x << " " << y;
        hidden += !seen;
      }
    }
    EXPECT_GT(hidden, 10);
  }
}

TEST(WhatMoves, HasTheTruthOfItsMoment) {
  const Camera camera = SmallCamera();
  const Pose T_wc = LookAt({0.2, -1.1, 1.5}, {0, 0, 0.8});
  const double time_s = 0.7;
  const TwoDesks desks(time_s);
  const FrameRenderer moving(desks.moving, camera), frozen(desks.frozen, camera);
  RenderOptions options;
  options.time_s = time_s;
  const FrameTruth is = TruthMaker(moving).Describe(moving.Render(T_wc, options), T_wc, time_s);
  const FrameTruth wanted = TruthMaker(frozen).Describe(frozen.Render(T_wc), T_wc);
  ASSERT_EQ(is.objects.size(), wanted.objects.size());
  for (std::size_t i = 0; i < is.objects.size(); ++i) {
    const ObjectInFrame &a = is.objects[i], &b = wanted.objects[i];
    ASSERT_EQ(a.id, b.id);
    EXPECT_NEAR(a.pixels, b.pixels, 2) << a.id;
    EXPECT_NEAR(a.amodal_box.x0, b.amodal_box.x0, 1e-9) << a.id;
    EXPECT_NEAR(a.amodal_box.y1, b.amodal_box.y1, 1e-9) << a.id;
    EXPECT_NEAR(a.visible_fraction, b.visible_fraction, 0.005) << a.id;
    ASSERT_EQ(a.T_wo.has_value(), a.id == 7);
  }
  EXPECT_LT((is.objects.back().T_wo->t - desks.frozen.objects[6].center_w).norm(), 1e-12);
  ASSERT_EQ(is.planes.size(), wanted.planes.size());
  int hidden = 0;
  for (std::size_t i = 0; i < is.planes.size(); ++i) {
    for (std::size_t k = 0; k < is.planes[i].vertices.size(); ++k) {
      EXPECT_EQ(is.planes[i].vertices[k].state, wanted.planes[i].vertices[k].state);
      hidden += is.planes[i].vertices[k].state == VertexState::kOccluded;
    }
  }
  EXPECT_GT(hidden, 0);
}

}  // namespace
}  // namespace sim
