#include "slam/calibrate/surface_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/cameras.h"

namespace slam {
namespace {

/// A wall at 1.5 m in pieces: the left and the right half have labels of their own.
struct TwoHalves {
  TwoHalves() {
    depth_m = cv::Mat1f(120, 160, 1.5F);
    labels = cv::Mat1b(120, 160, std::uint8_t{1});
    labels.colRange(82, 160) = 2;
  }
  std::vector<SurfaceView> Views() const {
    const WarpCells cells = CellsOf(camera);
    return ViewSurfaces(depth_m, labels, PixelRays(camera), cells, DepthNoise{},
                        Eigen::VectorXd::Zero(cells.count()),
                        Eigen::VectorXd::Constant(cells.count(), 0.0033), BendLaw::kDepth);
  }
  Camera camera = SmallCamera();
  cv::Mat1f depth_m;
  cv::Mat1b labels;
};

TEST(SurfaceViews, ThePlaneIsFreedOfTheKnownPatternAsItGoesWithTheDepth) {
  const TwoHalves scene;
  const WarpCells cells = CellsOf(scene.camera);
  for (const BendLaw law : {BendLaw::kDepth, BendLaw::kDisparity}) {
    const double share = law == BendLaw::kDepth ? 0.008 : 0.008 * 1.5 / kBendDistance_m;
    const std::vector<SurfaceView> views =
        ViewSurfaces(scene.depth_m, scene.labels, PixelRays(scene.camera), cells, DepthNoise{},
                     Eigen::VectorXd::Constant(cells.count(), 0.008),
                     Eigen::VectorXd::Constant(cells.count(), 0.0033), law);
    ASSERT_FALSE(views.empty());
    EXPECT_NEAR(views[0].plane.InverseDepth(0, 0), (1 + share) / 1.5, 1e-6);
  }
}

TEST(SurfaceViews, PiecesThatTouchWithoutAStepAreOneSurface) {
  const std::vector<SurfaceView> views = TwoHalves().Views();
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].cells.size(), 32U * 24U);
  EXPECT_NEAR(1 / views[0].plane.InverseDepth(0, 0), 1.5, 1e-6);
}

TEST(SurfaceViews, PiecesOfAChainAreOneSurfaceInWhateverOrderTheyAreLabelled) {
  constexpr int kPieces = 5, kWidth_px = 32;
  TwoHalves wall;
  std::array<std::uint8_t, kPieces> order{1, 2, 3, 4, 5};
  do {
    for (std::size_t k = 0; k < kPieces; ++k) {
      const int left = static_cast<int>(k) * kWidth_px;
      wall.labels.colRange(left, left + kWidth_px) = order[k];
    }
    const std::vector<SurfaceView> views = wall.Views();
    ASSERT_EQ(views.size(), 1U) << testing::PrintToString(order);
    EXPECT_EQ(views[0].cells.size(), 32U * 24U);
  } while (std::next_permutation(order.begin(), order.end()));
}

TEST(SurfaceViews, AStepOfEightMillimetresKeepsPiecesApart) {
  TwoHalves halves;
  halves.depth_m.colRange(82, 160) = 1.492F;
  EXPECT_EQ(halves.Views().size(), 2U);
}

TEST(SurfaceViews, ACreaseKeepsPiecesApart) {
  TwoHalves halves;
  for (int u = 82; u < 160; ++u) {
    halves.depth_m.col(u) = 1.5F / (1.0F + 0.2F * static_cast<float>(u - 82) / 131.25F);
  }
  EXPECT_EQ(halves.Views().size(), 2U);
}

TEST(SurfaceViews, PiecesTouchInCellsOfWhichOneHasAFifth) {
  TwoHalves halves;  // of a large image, whose cells are 20 pixels wide: the edge is 4 into one
  halves.camera = Camera{};
  halves.depth_m = cv::Mat1f(480, 640, 1.5F);
  halves.labels = cv::Mat1b(480, 640, std::uint8_t{1});
  halves.labels.colRange(324, 640) = 2;
  EXPECT_EQ(halves.Views().size(), 1U);
}

TEST(SurfaceViews, SmallThingsAndWhatIsNotMeasuredAreLeftOut) {
  TwoHalves halves;
  halves.labels.setTo(0);
  halves.labels(cv::Rect(10, 10, 20, 20)) = 3;  // 2 % of the image
  EXPECT_TRUE(halves.Views().empty());
  halves.labels.setTo(1);
  halves.depth_m(cv::Rect(0, 0, 80, 120)).setTo(0);
  const std::vector<SurfaceView> views = halves.Views();
  ASSERT_EQ(views.size(), 1U);
  EXPECT_EQ(views[0].cells.size(), 16U * 24U);
}

}  // namespace
}  // namespace slam
