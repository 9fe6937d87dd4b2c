#include "slam/segment/box_split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <opencv2/core.hpp>
#include <optional>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "slam/segment/extraction_config.h"
#include "slam/segment/plane_segments.h"
#include "tests/support/closed_form_depth.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// A table seen from above at a slant: inverse depth of a pixel.
const LabelPlane kTable{{0.1, 0.5, 1.0}, 1.0};
constexpr std::uint8_t kHost = 1;

/// Height over the table at a pixel, in sigmas of one depth.
using Height = std::function<double(int u, int v)>;

Height Raised(const cv::Rect& where, double sigmas) {
  return [=](int u, int v) { return where.contains({u, v}) ? sigmas : 0.0; };
}

/// Errors of variance 1 that 4 x 4 pixels share, as the model of the noise has it.
cv::Mat1f SharedErrors(const cv::Size& size, std::uint64_t seed) {
  Random random{seed};
  cv::Mat1f white(size.height + 3, size.width + 3), out(size);
  for (float& at : white) {
    double sum = -6.0;  // a sum of twelve: variance 1
    for (int k = 0; k < 12; ++k) sum += random.Uniform();
    at = static_cast<float>(sum);
  }
  for (int v = 0; v < out.rows; ++v) {
    for (int u = 0; u < out.cols; ++u)
      out(v, u) = static_cast<float>(cv::sum(white(cv::Rect(u, v, 4, 4)))[0] / 4.0);
  }
  return out;
}

/// The table with something on it, all one segment.
struct Plate {
  Plate(std::uint64_t seed, const Height& height) : labels(240, 320, kHost) {
    Camera camera;
    camera.width = labels.cols, camera.height = labels.rows;
    camera.cx = 160, camera.cy = 120;
    grid = MakeDepthGrid(cv::Mat1f(labels.size(), 1.0f), PixelRays(camera), noise, 10.0);
    const cv::Mat1f error = SharedErrors(labels.size(), seed);
    for (int v = 0; v < labels.rows; ++v) {
      for (int u = 0; u < labels.cols; ++u) {
        const auto i = static_cast<std::size_t>(grid.Index(u, v));
        const double q = kTable.plane.InverseDepth(static_cast<double>(grid.x[i]),
                                                   static_cast<double>(grid.y[i]));
        const double sigma_q = q * q * noise.Sigma(1.0 / q);
        const double off = height(u, v) + static_cast<double>(error(v, u));
        grid.q[i] = static_cast<float>(q + off * sigma_q);
        grid.g[i] = static_cast<float>(1.0 / sigma_q);
      }
    }
  }
  bool Find(const Box& box_px, const Box& own_px = {}) {
    const std::optional<PixelRegion> found =
        FindThinTop(grid, labels, kHost, kTable, box_px, own_px, noise, config);
    top = found.value_or(PixelRegion{});
    return found.has_value();
  }
  double IouWith(const cv::Rect& where) const {
    int shared = 0;
    for (const int i : top.pixels)
      shared += where.contains({i % grid.width, i / grid.width}) ? 1 : 0;
    return shared / (where.area() + static_cast<double>(top.pixels.size()) - shared);
  }
  DepthNoise noise;
  PlaneExtractionConfig config;
  cv::Mat1b labels;
  DepthGrid grid;
  PixelRegion top;  ///< what the last search has found
};

Box BoxOf(const cv::Rect& r, double du = 0.0, double dv = 0.0) {
  return {{r.x + du, r.y + dv}, {r.x + r.width - 1 + du, r.y + r.height - 1 + dv}};
}

const cv::Rect kPhone(110, 80, 90, 60);

TEST(BoxSplit, FindsAStepOfTwoSigmasWithItsOutline) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    Plate plate(seed, Raised(kPhone, 2.0));
    ASSERT_TRUE(plate.Find(BoxOf(kPhone))) << "seed " << seed;
    EXPECT_GT(plate.IouWith(kPhone), 0.8) << "seed " << seed;
  }
}

TEST(BoxSplit, FindsTheThingAndNotTheBoxWhereTheBoxIsOff) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Plate plate(seed, Raised(kPhone, 2.5));
    ASSERT_TRUE(plate.Find(BoxOf(kPhone, 7.0, -6.0))) << "seed " << seed;
    EXPECT_GT(plate.IouWith(kPhone), 0.85) << "seed " << seed;
  }
}

TEST(BoxSplit, FindsNothingInNoise) {
  // None of 1,000 boxes: with 95 % confidence the false-alarm rate is below 0.3 %.
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Plate plate(100 + seed, [](int, int) { return 0.0; });
    Random random{seed};
    for (int k = 0; k < 40; ++k) {
      const double w = 25.0 + 120.0 * random.Uniform(), h = 25.0 + 90.0 * random.Uniform();
      const double u = (320.0 - w) * random.Uniform(), v = (240.0 - h) * random.Uniform();
      EXPECT_FALSE(plate.Find({{u, v}, {u + w, v + h}})) << "seed " << seed << " box " << k;
    }
  }
}

TEST(BoxSplit, FindsNothingInTheMiddleOfAHighThing) {
  Plate plate(1, Raised({60, 40, 200, 150}, 2.5));
  EXPECT_FALSE(plate.Find(BoxOf(kPhone)));
}

TEST(BoxSplit, FindsNothingWhereTheSensorBendsTheTable) {
  const Height bump = [](int u, int v) {
    const double du = (u - 155) / 45.0, dv = (v - 110) / 45.0;
    return 2.0 * std::exp(-0.5 * (du * du + dv * dv));
  };
  Plate plate(1, bump);
  const Box box_px{{65, 20}, {245, 200}};
  EXPECT_FALSE(plate.Find(box_px, box_px));
}

TEST(BoxSplit, FindsNothingAtTheEdgeOfSomethingThatGoesOn) {
  Plate plate(1, Raised({160, 0, 160, 240}, 2.5));
  const Box box_px{{130, 80}, {230, 140}};
  EXPECT_FALSE(plate.Find(box_px, box_px));
}

TEST(BoxSplit, FindsNothingWhereABendGoesOnAroundTheBox) {
  const Height bend = [](int u, int v) {
    const double du = (u - 155) / 70.0, dv = (v - 110) / 70.0;
    return 2.0 * std::exp(-0.5 * (du * du + dv * dv));
  };
  Plate plate(1, bend);
  EXPECT_FALSE(plate.Find({{95, 50}, {215, 170}}));
}

TEST(BoxSplit, FindsNothingBelowTheTable) {
  Plate plate(1, Raised(kPhone, -2.5));
  EXPECT_FALSE(plate.Find(BoxOf(kPhone)));
}

TEST(BoxSplit, AsksARegionToFillItsBoxUnlessTheRestIsExplained) {
  const cv::Rect base(100, 130, 120, 40), lid(100, 40, 120, 90);
  Plate plate(1, Raised(base, 2.5));
  plate.labels(lid) = 2;  // a segment of its own
  const Box laptop_px = BoxOf(base | lid);
  EXPECT_FALSE(plate.Find(laptop_px));
  ASSERT_TRUE(plate.Find(laptop_px, BoxOf(lid)));
  EXPECT_GT(plate.IouWith(base), 0.8);
}

TEST(BoxSplit, FindsNothingInTheMiddleBetweenTwoThings) {
  const cv::Rect left(40, 80, 70, 60), right(210, 80, 70, 60);
  const Height two = [=](int u, int v) {
    return left.contains({u, v}) || right.contains({u, v}) ? 2.5 : 0.0;
  };
  Plate plate(1, two);
  EXPECT_FALSE(plate.Find(BoxOf(left | right)));
  EXPECT_TRUE(plate.Find(BoxOf(left)));
  EXPECT_GT(plate.IouWith(left), 0.8);
}

/// A desk with a thin book, and the box of that; the settings believe in twice the noise.
struct ThinBook {
  explicit ThinBook(bool enabled) {
    closed_form::World world = closed_form::Desk();
    closed_form::PutOnDesk(world, 0.0, 0.0, {0.16, 0.22, 0.005}, 0.3, "book");
    const Pose T_cw = closed_form::LookAt({0.05, -0.65, 0.8}, {0, 0, 0});
    const closed_form::View view = closed_form::Render(world, camera, T_cw);
    top = view.face == closed_form::FaceId(1, closed_form::kTop);
    Box box_px;
    for (int v = 0; v < top.rows; ++v) {
      for (int u = 0; u < top.cols; ++u)
        if (top(v, u) != 0) box_px.Include(Eigen::Vector2d(u, v));
    }
    PlaneExtractionConfig config = ExtractionFor(DepthSensor::kD435);
    config.box_split.enabled = enabled;
    frame = closed_form::MakeFrame(closed_form::AddKinectNoise(view.depth_m, 5));
    extractor.emplace(camera, PixelRays(camera), ModelOf(DepthSensor::kD435), config);
    extractor->Extract(frame);
    Detection detection{"book", ClassKind::kRegular, 0.9, box_px, false};
    frame.detections = {detection};
  }
  /// The share of the book in the segment that has most of it, and the other way round.
  double Iou() const {
    double best = 0.0;
    for (const FramePlane& plane : frame.planes) {
      const cv::Mat1b mask = cv::Mat(frame.plane_labels == plane.index + 1);
      const double shared = cv::countNonZero(mask & top);
      best = std::max(best, shared / (cv::countNonZero(mask) + cv::countNonZero(top) - shared));
    }
    return best;
  }
  Camera camera;
  cv::Mat1b top;
  Frame frame;
  std::optional<PlaneExtractor> extractor;
};

TEST(BoxSplit, MakesAWholeSegmentOfAThinBook) {
  ThinBook book(true);
  ASSERT_LT(book.Iou(), 0.3) << "it is no test if extraction finds it alone";
  book.extractor->SplitInBoxes(book.frame);
  EXPECT_GT(book.Iou(), 0.8);
  ASSERT_GE(book.frame.planes.size(), 2u);
  for (const FramePlane& plane : book.frame.planes) {
    EXPECT_EQ(cv::countNonZero(book.frame.plane_labels == plane.index + 1), plane.pixel_count);
    EXPECT_FALSE(plane.points_c.empty());
    EXPECT_FALSE(plane.edge_points.empty());
    EXPECT_GT(plane.offset_sigma_m, 0.0);
    EXPECT_GT(plane.roughness, 0.0);
  }
  EXPECT_GT(book.frame.planes[0].pixel_count, book.frame.planes[1].pixel_count);
}

TEST(BoxSplit, LeavesTheFrameWhereNothingRegularIsDetected) {
  for (const ClassKind kind : {ClassKind::kUnstructured, ClassKind::kOther}) {
    ThinBook book(true);
    book.frame.detections[0].kind = kind;
    const cv::Mat1b before = book.frame.plane_labels.clone();
    book.extractor->SplitInBoxes(book.frame);
    EXPECT_EQ(cv::countNonZero(before != book.frame.plane_labels), 0);
  }
}

TEST(BoxSplit, IsOffWhenItIsSwitchedOff) {
  ThinBook book(false);
  const cv::Mat1b before = book.frame.plane_labels.clone();
  book.extractor->SplitInBoxes(book.frame);
  EXPECT_EQ(cv::countNonZero(before != book.frame.plane_labels), 0);
}

TEST(BoxSplit, DoesNotDependOnTheOrderOfTheBoxes) {
  ThinBook a(true), b(true);
  Detection wide = a.frame.detections[0];
  wide.box_px.max += Eigen::Vector2d(12.0, 9.0);
  a.frame.detections = {a.frame.detections[0], wide};
  b.frame.detections = {wide, b.frame.detections[0]};
  a.extractor->SplitInBoxes(a.frame);
  b.extractor->SplitInBoxes(b.frame);
  EXPECT_EQ(cv::countNonZero(a.frame.plane_labels != b.frame.plane_labels), 0);
}

}  // namespace
}  // namespace slam
