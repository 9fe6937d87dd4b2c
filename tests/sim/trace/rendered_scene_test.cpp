#include "sim/trace/rendered_scene.h"

#include <gtest/gtest.h>

#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

void MakeAllFaces(Object& object, double infrared, double gloss) {
  for (Material& face : object.faces) {
    face.infrared = infrared;
    face.gloss = gloss;
  }
}

// A dark screen with a bright matt thing that passes before it, and the other way round.
TEST(RenderMoving, GivesEachPixelTheSurfaceOfWhatItShows) {
  for (const bool screen_stands : {true, false}) {
    Scene scene = OneBoard(2.0);
    Object passer = BoxObject(2, "box", Role::kUnstructured, {-0.5, 1, 0}, {0.4, 0.2, 0.3});
    passer.way = {{0, {-0.5, 1, 0}, 0}, {1, {0.5, 1, 0}, 0}};
    scene.objects.push_back(passer);
    MakeAllFaces(scene.objects[screen_stands ? 0 : 1], 0.003, 1.0);
    MakeAllFaces(scene.objects[screen_stands ? 1 : 0], 0.6, 0.0);
    RenderOptions options;
    options.time_s = 0.6;
    options.colour = false;
    const Rendering seen = FrameRenderer(scene, SmallCamera()).Render(LookAlongY(), options);
    int passing = 0;
    for (int v = 0; v < seen.gloss.rows; ++v) {
      for (int u = 0; u < seen.gloss.cols; ++u) {
        passing += seen.object_id(v, u) == 2;
        const bool is_screen = (seen.object_id(v, u) == 1) == screen_stands;
        ASSERT_EQ(seen.gloss(v, u), is_screen ? 1.0F : 0.0F) << u << " " << v;
        ASSERT_EQ(seen.infrared(v, u), is_screen ? 0.003F : 0.6F) << u << " " << v;
        // Camera and projector are in one place: half way between them is where it looks from.
        if (!is_screen) continue;
        ASSERT_NEAR(seen.mirror_cos(v, u), seen.incidence_cos(v, u), 1e-6) << u << " " << v;
      }
    }
    EXPECT_GT(passing, 500);
  }
}

}  // namespace
}  // namespace sim
