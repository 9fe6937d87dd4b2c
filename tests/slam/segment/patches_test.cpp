#include "slam/segment/patches.h"

#include <gtest/gtest.h>

#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// Three strips of a noisy image side by side: a desk 1 m away, a sheet on it that rises by
/// 1 cm towards the left, and what is `right_m` away. The step left of the sheet keeps the desk
/// and the sheet apart.
struct SheetOnADesk {
  explicit SheetOnADesk(float right_m) {
    Camera camera;
    camera.width = 90, camera.height = 50;
    cv::Mat1f depth_m(50, 90, 1.0f);
    LabelImage labels(50 * 90);
    for (int v = 0; v < 50; ++v) {
      for (int u = 0; u < 90; ++u) {
        labels[static_cast<std::size_t>(v * 90 + u)] = static_cast<std::int16_t>(u < 35   ? 0
                                                                                 : u < 55 ? 1
                                                                                          : 2);
        if (u >= 35) depth_m(v, u) = 0.99f + 0.01f * static_cast<float>(u - 35) / 20.0f;
        if (u >= 55) depth_m(v, u) = right_m;
      }
    }
    const DepthGrid grid =
        MakeDepthGrid(closed_form::AddKinectNoise(depth_m, 1), PixelRays(camera), noise, 10.0);
    const std::vector<PlaneSums> sums = SumLabels(grid, labels, 3);
    patches.Begin(sums, {3, LabelPlane{}}, noise);
    patches.KeepApart(0, 1);
  }
  DepthNoise noise;
  PlaneExtractionConfig config;
  PatchUnion patches;
};

TEST(PatchUnion, ContestsASheetWhoseOtherEdgeIsRaisedOverTheSameDesk) {
  const SheetOnADesk scene(1.0f);
  EXPECT_TRUE(scene.patches.IsAmbiguous(1, 2, scene.noise, scene.config));
  EXPECT_FALSE(scene.patches.IsAmbiguous(2, 1, scene.noise, scene.config))
      << "nothing is apart from the right";
  EXPECT_FALSE(scene.patches.IsAmbiguous(1, 0, scene.noise, scene.config))
      << "that is what Apart() says";
}

TEST(PatchUnion, DoesNotContestASheetBesideAnotherSurface) {
  const SheetOnADesk scene(1.05f);
  EXPECT_FALSE(scene.patches.IsAmbiguous(1, 2, scene.noise, scene.config));
}

TEST(PatchUnion, KeepsASheetApartFromADeskWhosePartsAreJoined) {
  SheetOnADesk scene(1.0f);
  scene.patches.Join(0, 2, scene.noise);
  EXPECT_TRUE(scene.patches.Apart(0, 1));
  EXPECT_FALSE(scene.patches.IsAmbiguous(1, 0, scene.noise, scene.config));
}

}  // namespace
}  // namespace slam
