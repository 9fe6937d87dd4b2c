#include "slam/segment/ahc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

LabelImage SegmentDepth(const cv::Mat1f& depth_m) {
  return SegmentByAhc(MakeDepthGrid(depth_m, PixelRays(Camera{}), {}, 10.0));
}

/// A room's corner: of three planes the nearest is seen.
struct Corner {
  cv::Mat1f depth_m;
  std::vector<int> seen;  ///< number of the plane, one a pixel

  Corner() {
    const Camera camera;
    const cv::Mat2d rays = PixelRays(camera);
    const InverseDepthPlane planes[] = {{0.0, 0.6, 0.7}, {0.6, 0.0, 0.7}, {-0.5, -0.4, 0.7}};
    depth_m.create(camera.height, camera.width);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        double q[3];
        for (int k = 0; k < 3; ++k) q[k] = planes[k].InverseDepth(rays(v, u)[0], rays(v, u)[1]);
        const auto nearest = std::max_element(q, q + 3);
        seen.push_back(static_cast<int>(nearest - q));
        depth_m(v, u) = static_cast<float>(1.0 / *nearest);
      }
    }
  }
};

TEST(Ahc, FindsTheThreePlanesOfACornerWithNoiseAndWithout) {
  const Corner corner;
  for (const bool noisy : {false, true}) {
    const LabelImage labels =
        SegmentDepth(noisy ? closed_form::AddKinectNoise(corner.depth_m, 1) : corner.depth_m);
    ASSERT_EQ(*std::max_element(labels.begin(), labels.end()), 2) << noisy;
    std::vector<std::vector<int>> shared(3, std::vector<int>(3));
    for (std::size_t i = 0; i < labels.size(); ++i)
      if (labels[i] != kNoLabel)
        ++shared[static_cast<std::size_t>(corner.seen[i])][static_cast<std::size_t>(labels[i])];
    for (int plane = 0; plane < 3; ++plane) {
      const auto pixels = std::count(corner.seen.begin(), corner.seen.end(), plane);
      const auto& by_label = shared[static_cast<std::size_t>(plane)];
      EXPECT_GT(*std::max_element(by_label.begin(), by_label.end()),
                (noisy ? 0.93 : 0.99) * static_cast<double>(pixels))
          << noisy << " " << plane;
    }
  }
}

TEST(Ahc, LabelsAPlaneWithoutNoiseToItsLastMeasuredPixel) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width, 1.0f);
  depth_m(cv::Rect(100, 100, 3, 3)) = 0.0f;
  const LabelImage labels = SegmentDepth(depth_m);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), camera.width * camera.height - 9);
  EXPECT_EQ(std::count(labels.begin(), labels.end(), kNoLabel), 9);
}

// As the program of its authors has it: neighbours outside of the image take nothing off a plane, and
// the last block of a row or column is joined by its own normal. At the other end there is no such rule.
TEST(Ahc, LabelsAStripTwoBlocksWideAlongTheRightAndTheLowerBorder) {
  const Camera camera;
  for (const cv::Rect& strip : {cv::Rect(camera.width - 20, 0, 20, camera.height),
                                cv::Rect(0, camera.height - 20, camera.width, 20)}) {
    cv::Mat1f depth_m(camera.height, camera.width, 0.0f);
    depth_m(strip) = 1.0f;
    const LabelImage labels = SegmentDepth(depth_m);
    EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), strip.area())
        << strip.width << " wide";
  }
}

TEST(Ahc, LeavesOutWhatHasFewerThanThreeThousandPixels) {
  const Camera camera;
  for (const auto& [side, label] : std::vector<std::pair<int, int>>{{50, kNoLabel}, {80, 0}}) {
    cv::Mat1f depth_m(camera.height, camera.width, 0.0f);
    depth_m(cv::Rect(200, 100, side, side)) = 1.0f;
    const LabelImage labels = SegmentDepth(depth_m);
    EXPECT_EQ(labels[static_cast<std::size_t>(120 * camera.width + 220)], label) << side;
    EXPECT_EQ(std::count(labels.begin(), labels.end(), 0), label == 0 ? side * side : 0);
  }
}

// A plane that cannot merge with anything when its turn comes is taken out of the graph
// (algorithm 3 of the paper). The wall is noisier than the patch, so that the patch is ready
// first: with a block of the wall its mean error would be 10.2 mm where 9.6 mm are allowed. With
// the whole wall, 63 times its size, it would be 8.9 mm.
TEST(Ahc, KeepsAPatchBeforeAWallThatIsMuchLarger) {
  const Camera camera;
  cv::Mat1f depth_m(camera.height, camera.width);
  Random random{1};
  for (float& z_m : depth_m) z_m = static_cast<float>(1.0 + 0.002 * (random.Uniform() - 0.5));
  depth_m(cv::Rect(300, 200, 80, 60)) = 1.0f - 0.072f;  // whole blocks: none jumps inside
  const LabelImage labels = SegmentDepth(depth_m);
  EXPECT_EQ(*std::max_element(labels.begin(), labels.end()), 1);
  const auto at = [&](int u, int v) {
    return labels[static_cast<std::size_t>(v * camera.width + u)];
  };
  EXPECT_NE(at(340, 230), kNoLabel);
  EXPECT_NE(at(340, 230), at(200, 230));
}

TEST(Ahc, FindsNothingInAnImageSmallerThanABlock) {
  Camera camera;
  camera.width = 7, camera.height = 5;
  const cv::Mat1f depth_m(5, 7, 1.0f);
  const LabelImage labels = SegmentByAhc(MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0));
  EXPECT_EQ(std::count(labels.begin(), labels.end(), kNoLabel), 35);
}

}  // namespace
}  // namespace slam
