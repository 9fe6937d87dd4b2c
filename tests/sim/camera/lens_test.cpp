#include "sim/camera/lens.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>

#include "sim/trace/frame_renderer.h"
#include "sim/truth/frame_truth.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

/// The first Kinect of the TUM benchmark, as calibrated there.
constexpr Lens kTum1{.k1 = 0.2624, .k2 = -0.9531, .p1 = -0.0054, .p2 = 0.0026, .k3 = 1.1633};

// OpenCV undoes the lens (iteratively); with the depth the point must lie on the desk or the
// wall that the id image names.
TEST(DistortedDepth, LiesOnThePlanesWhenOpenCvUndoesTheLens) {
  const Camera camera = WithLens(SmallCamera(), kTum1);
  const Scene scene = SmallDesk();
  const Pose T_wc = SmallArc(1)[0].T_wc;
  const Rendering rendering = FrameRenderer(scene, camera).Render(T_wc, {.colour = false});
  const cv::Matx33d K(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1);
  const Lens& k = camera.lens;
  const cv::TermCriteria exact(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-12);
  int desk = 0, wall = 0;
  for (int v = 0; v < camera.height; v += 3) {
    for (int u = 0; u < camera.width; u += 3) {
      std::vector<cv::Point2d> ray;
      cv::undistortPoints(std::vector<cv::Point2d>{{double(u), double(v)}}, ray, K,
                          cv::Vec<double, 5>(k.k1, k.k2, k.p1, k.p2, k.k3), cv::noArray(),
                          cv::noArray(), exact);
      const Eigen::Vector3d p_w =
          T_wc * (rendering.depth_m(v, u) * Eigen::Vector3d(ray[0].x, ray[0].y, 1));
      if (rendering.object_id(v, u) == 3 && p_w.y() > -0.39) {
        EXPECT_NEAR(p_w.z(), 0.75, 1e-8);
        ++desk;
      }
      if (rendering.object_id(v, u) == 2) {
        EXPECT_NEAR(p_w.y(), 0.95, 1e-8);
        ++wall;
      }
    }
  }
  EXPECT_GT(desk, 100);
  EXPECT_GT(wall, 20);
}

TEST(DistortedTruth, BoxesHoldWhatIsSeen) {
  const Camera camera = WithLens(SmallCamera(), {.k1 = -0.25, .k2 = 0.05});
  const Scene scene = SmallDesk();
  const FrameRenderer renderer(scene, camera);
  const Pose T_wc = SmallArc(1)[0].T_wc;
  const FrameTruth truth = TruthMaker(renderer).Describe(renderer.Render(T_wc), T_wc);
  ASSERT_GT(truth.objects.size(), 4U);
  for (const ObjectInFrame& object : truth.objects) {
    EXPECT_LE(object.amodal_box.x0, object.visible_box.x0 + 1e-6) << object.id;
    EXPECT_LE(object.amodal_box.y0, object.visible_box.y0 + 1e-6) << object.id;
    EXPECT_GE(object.amodal_box.x1, object.visible_box.x1 - 1e-6) << object.id;
    EXPECT_GE(object.amodal_box.y1, object.visible_box.y1 - 1e-6) << object.id;
    EXPECT_GE(object.unoccluded_pixels, object.pixels);
  }
}

}  // namespace
}  // namespace sim
