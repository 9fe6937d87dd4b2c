#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "sim/trace/frame_renderer.h"
#include "tests/sim/support/sim_worlds.h"

namespace sim {
namespace {

constexpr int kFiner = 8;

/// Plain colours, so that what pixels differ by is surfaces and shadows.
Scene PlainDesk() {
  Scene scene = SmallDesk();
  for (Object& object : scene.objects) {
    for (Material& face : object.faces) {
      face.print = Print::kPlain;
      face.colour = {0.9, object.id % 2 == 0 ? 0.8 : 0.3, 0.5};
    }
  }
  return scene;
}

struct Errors {
  double smooth = 0, centre = 0;  ///< root mean square, of edge pixels
  double bias = 0;
  int pixels = 0, wrong = 0;
};

/// Against the mean of 64 finer pixels; `centre` is what one of them in the middle is off by.
Errors AtEdges(const Scene& scene, const Pose& T_wc) {
  const Camera camera = Resize(Camera{}, 160, 120);
  const cv::Mat3f seen = FrameRenderer(scene, camera).Render(T_wc).radiance;
  const Camera finer = Resize(Camera{}, 160 * kFiner, 120 * kFiner);
  const cv::Mat3f fine = FrameRenderer(scene, finer).Render(T_wc).radiance;
  cv::Mat3f mean;
  cv::resize(fine, mean, seen.size(), 0, 0, cv::INTER_AREA);
  Errors sum;
  for (int v = 1; v + 1 < seen.rows; ++v) {
    for (int u = 1; u + 1 < seen.cols; ++u) {
      const cv::Vec3f middle = fine(v * kFiner + kFiner / 2, u * kFiner + kFiner / 2);
      const cv::Vec3f expected = mean(v, u);
      const double spread = cv::norm(expected - middle);
      if (spread < 0.02) continue;
      const double off = cv::norm(seen(v, u) - expected);
      ++sum.pixels;
      sum.smooth += off * off;
      sum.centre += spread * spread;
      sum.bias += seen(v, u)[1] - expected[1];
      sum.wrong += off > 0.25 ? 1 : 0;
    }
  }
  sum.smooth = std::sqrt(sum.smooth / sum.pixels);
  sum.centre = std::sqrt(sum.centre / sum.pixels);
  sum.bias /= sum.pixels;
  return sum;
}

TEST(ColourAtEdges, OfSurfacesAndShadowsIsNearTheMeanOfManyRays) {
  for (const TimedPose& at : SmallArc(3)) {
    const Errors errors = AtEdges(PlainDesk(), at.T_wc);
    ASSERT_GT(errors.pixels, 500);
    // Four rays, well spread, leave a third of what one is off by.
    EXPECT_LT(errors.smooth, 0.4 * errors.centre);
    EXPECT_LT(std::abs(errors.bias), 0.003);
    EXPECT_LT(errors.wrong, errors.pixels / 100);
  }
}

}  // namespace
}  // namespace sim
