#include "slam/segment/map_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/core.hpp>
#include <optional>

#include "slam/segment/depth_sensor.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

constexpr double kBook_m = 0.005;

/// A desk with a thin book on it, or without; the settings believe in twice the noise, so that
/// extraction does not find the book. What the map knows is up to the test.
struct KnownBook {
  explicit KnownBook(std::uint64_t seed = 5, bool book_is_there = true, bool enabled = true) {
    world = closed_form::Desk();
    closed_form::PutOnDesk(world, 0.0, 0.0, {0.16, 0.22, kBook_m}, 0.3, "book");
    book = world.boxes.back();
    if (!book_is_there) world.boxes.pop_back();
    const closed_form::View view = closed_form::Render(world, camera, T_cw);
    top = view.face == closed_form::FaceId(1, closed_form::kTop);
    PlaneExtractionConfig config = ExtractionFor(DepthSensor::kD435);
    config.box_split.enabled = false;
    config.map_split.enabled = enabled;
    frame = closed_form::MakeFrame(closed_form::AddKinectNoise(view.depth_m, seed));
    extractor.emplace(camera, PixelRays(camera), config);
    extractor->Extract(frame);
  }
  /// The top of a book as the map knows it, raised by `off_m`.
  ExpectedPlane Book(double off_m = 0.0) const {
    ExpectedPlane at;
    Plane pi_w = closed_form::FacePlane(book, closed_form::kTop);
    pi_w.d -= off_m;
    at.pi_c = Transform(T_cw, pi_w);
    for (const Eigen::Vector3d& corner_w : closed_form::TopCorners(book))
      at.outline_px.push_back(camera.Project(T_cw * corner_w));
    at.margin_px = 3.0;
    return at;
  }
  /// The desk, of which no outline is needed.
  ExpectedPlane Desk() const {
    ExpectedPlane at;
    at.pi_c = Transform(T_cw, closed_form::FacePlane(world.boxes[0], closed_form::kTop));
    return at;
  }
  /// All that is expected by a camera that believes to be off along the desk's normal.
  bool SplitWhenOffBy(double off_m, std::vector<ExpectedPlane> expected) {
    for (ExpectedPlane& at : expected) at.pi_c.d += off_m;
    return extractor->SplitByMap(frame, expected);
  }
  double Iou() const {
    double best = 0.0;
    for (const FramePlane& plane : frame.planes) {
      const cv::Mat1b mask = cv::Mat(frame.plane_labels == plane.index + 1);
      const double shared = cv::countNonZero(mask & top);
      best = std::max(best, shared / (cv::countNonZero(mask) + cv::countNonZero(top) - shared));
    }
    return best;
  }
  const Pose T_cw = closed_form::LookAt({0.05, -0.65, 0.8}, {0, 0, 0});
  Camera camera;
  closed_form::World world;
  closed_form::BoxBody book;
  cv::Mat1b top;
  Frame frame;
  std::optional<PlaneExtractor> extractor;
};

TEST(MapSplit, FindsAKnownBookInTheDesk) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    KnownBook known(seed);
    ASSERT_LT(known.Iou(), 0.3) << "it is no test if extraction finds it alone";
    EXPECT_TRUE(known.SplitWhenOffBy(0.0, {known.Desk(), known.Book()})) << "seed " << seed;
    EXPECT_GT(known.Iou(), 0.85) << "seed " << seed;
    for (const FramePlane& plane : known.frame.planes) {
      EXPECT_EQ(cv::countNonZero(known.frame.plane_labels == plane.index + 1),
                plane.pixel_count);
      EXPECT_FALSE(plane.edge_points.empty());
      EXPECT_GT(plane.offset_sigma_m, 0.0);
    }
  }
}

TEST(MapSplit, DoesNotCareWhereThePoseIsOffByAsMuchAsTheStep) {
  for (const double off_m : {-kBook_m, -0.003, 0.003, kBook_m}) {
    KnownBook known;
    EXPECT_TRUE(known.SplitWhenOffBy(off_m, {known.Desk(), known.Book()})) << off_m;
    EXPECT_GT(known.Iou(), 0.85) << off_m;
  }
}

TEST(MapSplit, DoesNotDependOnTheOrderOfTheMap) {
  KnownBook a, b;
  a.SplitWhenOffBy(0.0, {a.Desk(), a.Book()});
  b.SplitWhenOffBy(0.0, {b.Book(), b.Desk()});
  EXPECT_EQ(cv::countNonZero(a.frame.plane_labels != b.frame.plane_labels), 0);
}

TEST(MapSplit, FindsNothingWhereTheBookIsGone) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    KnownBook gone(seed, false);
    const cv::Mat1b before = gone.frame.plane_labels.clone();
    for (const double off_m : {-kBook_m, 0.0, kBook_m}) {
      EXPECT_FALSE(gone.SplitWhenOffBy(off_m, {gone.Desk(), gone.Book()})) << "seed " << seed;
    }
    EXPECT_EQ(cv::countNonZero(before != gone.frame.plane_labels), 0);
  }
}

TEST(MapSplit, AsksForTheStepOfTheMap) {
  KnownBook known;
  for (const double more_m : {0.005, 0.006, 0.012}) {
    EXPECT_FALSE(known.SplitWhenOffBy(0.0, {known.Desk(), known.Book(more_m)}))
        << "the step is not that of the map, " << more_m;
  }
  EXPECT_FALSE(known.SplitWhenOffBy(0.0, {known.Book()})) << "nothing is known of the desk";
  EXPECT_FALSE(known.SplitWhenOffBy(0.04, {known.Desk(), known.Book()}))
      << "farther off than a pose may be";
}

TEST(MapSplit, FindsNothingInNoise) {
  // A small step in a large outline, for which noise elects regions: they are not beyond doubt.
  Camera camera;
  camera.width = 320, camera.height = 240, camera.cx = 160, camera.cy = 120;
  const PlaneExtractionConfig config;
  const InverseDepthPlane table{0.1, 0.5, 1.0};
  const Plane table_c = table.Hessian();
  const std::vector<ExpectedPlane> expected = {
      {table_c, {}, 0.0},
      {{table_c.n, table_c.d - 0.0014}, {{60, 40}, {260, 40}, {260, 200}, {60, 200}}, 3.0}};
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    DepthGrid grid = MakeDepthGrid(cv::Mat1f(camera.height, camera.width, 1.0f),
                                   PixelRays(camera), config.noise, 10.0);
    Random random{seed};
    cv::Mat1d white(camera.height + 3, camera.width + 3);
    for (double& at : white) at = closed_form::Gaussian(random);
    Segment segment;
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const auto i = static_cast<std::size_t>(grid.Index(u, v));
        const double x = static_cast<double>(grid.x[i]), y = static_cast<double>(grid.y[i]);
        const double q = table.InverseDepth(x, y);
        const double sigma_q = q * q * config.noise.Sigma(1.0 / q);
        // Variance 1, shared by 4 x 4 pixels, as the model of the noise has it.
        const double error = cv::sum(white(cv::Rect(u, v, 4, 4)))[0] / 4.0;
        grid.q[i] = static_cast<float>(q + error * sigma_q);
        grid.g[i] = static_cast<float>(1.0 / sigma_q);
        segment.sums.Add(x, y, static_cast<double>(grid.q[i]), 1.0 / (sigma_q * sigma_q));
      }
    }
    segment.plane = {table, 1.0};
    segment.high = {camera.width - 1, camera.height - 1};
    const cv::Mat1b labels(camera.height, camera.width, std::uint8_t{1});
    MapSplit split;
    EXPECT_FALSE(split.Find(grid, labels, 0, segment, expected, 1, config)) << "seed " << seed;
  }
}

TEST(MapSplit, IsOffWhenItIsSwitchedOff) {
  KnownBook known(5, true, false);
  EXPECT_FALSE(known.SplitWhenOffBy(0.0, {known.Desk(), known.Book()}));
}

}  // namespace
}  // namespace slam
