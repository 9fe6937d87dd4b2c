#include "slam/segment/occluded_parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "slam/geometry/camera.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

constexpr float kTop_m = 1.0f, kGround_m = 1.1f, kInFront_m = 0.9f;

/// Depth and labels of an image that rectangles are painted into; at first ground without label.
struct Picture {
  cv::Mat1f depth_m = cv::Mat1f(120, 160, kGround_m);
  LabelImage labels = LabelImage(120 * 160, kNoLabel);
  std::set<int> bent;  ///< labels

  void Paint(const cv::Rect& where, float z_m, int label = kNoLabel) {
    depth_m(where).setTo(z_m);
    for (int v = where.y; v < where.y + where.height; ++v)
      std::fill_n(labels.begin() + v * depth_m.cols + where.x, where.width,
                  static_cast<std::int16_t>(label));
  }
};

struct Segmented {
  int count = 0;
  LabelImage image;

  int At(int u, int v) const { return image[static_cast<std::size_t>(v * 160 + u)]; }
};

/// The segments, whose sums are checked pixel by pixel.
Segmented Segment(const Picture& picture, const PlaneExtractionConfig& config = {}) {
  Camera camera;
  camera.width = picture.depth_m.cols, camera.height = picture.depth_m.rows;
  const DepthNoise noise;
  const DepthGrid grid = MakeDepthGrid(picture.depth_m, PixelRays(camera), noise, 10.0);
  std::vector<Surface> surfaces(1 + static_cast<std::size_t>(*std::max_element(
                                        picture.labels.begin(), picture.labels.end())));
  for (std::size_t i = 0; i < picture.labels.size(); ++i)
    if (picture.labels[i] != kNoLabel)
      AddPixel(grid, i, surfaces[static_cast<std::size_t>(picture.labels[i])].sums);
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    surfaces[k].plane.plane = Fit(surfaces[k].sums)->plane;
    surfaces[k].bent = picture.bent.contains(static_cast<int>(k));
  }
  LabelRuns runs;
  FindRuns(picture.labels, grid.width, grid.height, runs);
  const PartSegments parts = SegmentParts(grid, surfaces, runs, noise, config);

  Segmented out{static_cast<int>(parts.sums.size()), LabelImage(picture.labels.size())};
  std::vector<PlaneSums> sums(parts.sums.size());
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      const int label = parts.runs.runs[parts.runs.At(u, v)].label;
      const auto i = static_cast<std::size_t>(grid.Index(u, v));
      out.image[i] = static_cast<std::int16_t>(label);
      if (label != kNoLabel) AddPixel(grid, i, sums[static_cast<std::size_t>(label)]);
    }
  }
  for (std::size_t k = 0; k < sums.size(); ++k) {
    EXPECT_EQ(parts.sums[k].n, sums[k].n) << k;
    EXPECT_NEAR(parts.sums[k].wqx, sums[k].wqx, 1e-6 * sums[k].wq) << k;
    EXPECT_NEAR(parts.sums[k].wqq, sums[k].wqq, 1e-6 * sums[k].wqq) << k;
  }
  return out;
}

/// A large top, left, and a smaller one, right, with something between them.
Picture TwoTops(float between_m, float right_m = kTop_m, int right_label = 1) {
  Picture picture;
  picture.Paint({10, 20, 60, 80}, kTop_m, 0);
  picture.Paint({70, 0, 20, 120}, between_m);
  picture.Paint({90, 20, 50, 60}, right_m, right_label);
  return picture;
}

TEST(SegmentParts, OfOnePlaneAreOneSegmentUnlessSomethingBehindItIsSeenBetween) {
  EXPECT_EQ(Segment(TwoTops(kInFront_m)).count, 1);
  EXPECT_EQ(Segment(TwoTops(0.0f)).count, 1) << "not measured";
  EXPECT_EQ(Segment(TwoTops(kGround_m)).count, 2);
}

TEST(SegmentParts, OfTwoPlanesStayApart) {
  const Segmented segments = Segment(TwoTops(kInFront_m, 1.02f));
  EXPECT_EQ(segments.count, 2);
  EXPECT_NE(segments.At(30, 50), segments.At(110, 50));
}

TEST(SegmentParts, OfOneLabelAreSplitWhereWhatIsBehindIsSeen) {
  EXPECT_EQ(Segment(TwoTops(kInFront_m, kTop_m, 0)).count, 1);
  const Segmented segments = Segment(TwoTops(kGround_m, kTop_m, 0));
  EXPECT_EQ(segments.count, 2);
  EXPECT_NE(segments.At(30, 50), segments.At(110, 50));
}

TEST(SegmentParts, ThatTouchAlongTheirBorderWereAskedForStepsAndStayApart) {
  for (const int rows : {6, 54}) {  // a fifth of the 260 sides around the smaller one are 52
    Picture picture = TwoTops(kInFront_m);
    picture.Paint({70, 50 - rows / 2, 20, rows}, kTop_m, 1);
    EXPECT_EQ(Segment(picture).count, rows == 6 ? 1 : 2) << rows;
  }
}

TEST(SegmentParts, ThatAreTooSmallAreNone) {
  PlaneExtractionConfig config;
  config.min_island_pixels = 40;
  for (const int side : {6, 7}) {
    Picture picture = TwoTops(kGround_m);
    picture.Paint({100, 100, side, side}, kTop_m, 0);
    const Segmented segments = Segment(picture, config);
    EXPECT_EQ(segments.count, side == 6 ? 2 : 3);
    EXPECT_EQ(segments.At(102, 102) == kNoLabel, side == 6);
  }
}

// 8 mm behind are four sigmas; a first Kinect bends the large top by as much.
TEST(SegmentParts, MayHaveBetweenThemWhatTheLargerOneMayBeBentBy) {
  Picture picture = TwoTops(1.008f);
  EXPECT_EQ(Segment(picture).count, 2);
  picture.bent = {1};
  EXPECT_EQ(Segment(picture).count, 2);
  picture.bent = {0};
  EXPECT_EQ(Segment(picture).count, 1);
}

// The largest lies on either side of the other two, so that no tilted plane makes it one with them.
TEST(SegmentParts, JoinTheLargerOneThatFitsThemBest) {
  for (const bool largest_fits : {true, false}) {
    Picture picture;
    picture.Paint({0, 0, 160, 120}, kInFront_m);
    for (const int u : {5, 125})
      picture.Paint({u, 10, 30, 100}, largest_fits ? 1.002f : 1.006f, 0);
    picture.Paint({45, 10, 70, 60}, largest_fits ? 0.994f : 0.998f, 1);
    picture.Paint({45, 80, 70, 30}, kTop_m, 2);
    const Segmented segments = Segment(picture);
    EXPECT_EQ(segments.count, 2);
    EXPECT_EQ(segments.At(80, 90) == segments.At(20, 50), largest_fits);
  }
}

// The second fits the third best, 2 mm nearer than the largest, whose part it is itself by then.
TEST(SegmentParts, OfOnePlaneUnderThreeLabelsAreOneSegment) {
  Picture picture;
  picture.Paint({0, 0, 160, 120}, kInFront_m);
  for (const int u : {5, 125}) picture.Paint({u, 10, 30, 100}, 1.002f, 0);
  for (const int v : {10, 80}) picture.Paint({45, v, 70, 30}, kTop_m, 1);
  picture.Paint({45, 50, 70, 20}, kTop_m, 2);
  EXPECT_EQ(Segment(picture).count, 1);
}

}  // namespace
}  // namespace slam
