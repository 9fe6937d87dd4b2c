#include "slam/segment/roughness.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/random.h"
#include "slam/geometry/camera.h"
#include "slam/segment/pixels/block_pixels.h"
#include "tests/support/depth_planes.h"

namespace slam {
namespace {

/// A table seen from above at a slant: inverse depth of a pixel.
const InverseDepthPlane kSlant{0.1, 0.5, 1.0};

/// Depth of that plane with independent noise of the model, and `raised_m` nearer.
template <typename Raised>
Roughness RoughnessOf(const Raised& raised_m, double noise_factor = 1.0) {
  const Camera camera;
  const DepthNoise noise;
  cv::Mat1f depth_m(camera.height, camera.width);
  Random random{3};
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector3d ray = camera.Backproject({u, v}, 1.0);
      const double z = 1.0 / kSlant.InverseDepth(ray.x(), ray.y());
      const double grazing = noise.GrazingFactor(z, kSlant.Cosine(ray.x(), ray.y()));
      double unit = -6.0;  // a sum of twelve: variance 1
      for (int k = 0; k < 12; ++k) unit += random.Uniform();
      depth_m(v, u) = static_cast<float>(z - raised_m(u, v) +
                                         noise_factor * unit * noise.Sigma(z) * grazing);
    }
  }
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), noise, 10.0);
  cv::Mat1b labels(camera.height, camera.width, static_cast<unsigned char>(0));
  const cv::Rect bounds(100, 80, 300, 200);
  labels(bounds) = 3;
  return MeasureRoughness(grid, labels, bounds, 3, kSlant, noise, 3);
}

TEST(Roughness, OfAPlaneIsThatOfItsNoise) {
  const auto flat = [](int, int) { return 0.0; };
  EXPECT_NEAR(RoughnessOf(flat).fine, 1.0, 0.05);
  EXPECT_NEAR(RoughnessOf(flat).coarse, 1.0, 0.05);
  EXPECT_NEAR(RoughnessOf(flat, 1.5).fine, 2.25, 0.1);
  EXPECT_NEAR(RoughnessOf(flat, 1.5).coarse, 2.25, 0.1);
}

TEST(Roughness, IsNotRaisedByAGentleBend) {
  const auto bowl = [](int u, int v) {
    return 1e-7 * ((u - 250.0) * (u - 250.0) + (v - 180.0) * (v - 180.0));  // 3 mm at the rim
  };
  EXPECT_NEAR(RoughnessOf(bowl).fine, 1.0, 0.05);
  EXPECT_NEAR(RoughnessOf(bowl).coarse, 1.0, 0.05);
}

TEST(Roughness, OfStairsIsMoreWhicheverWayTheyRun) {
  const auto stairs = [](int along) { return along / 8 % 2 == 0 ? 0.004 : -0.004; };
  for (const Roughness& r : {RoughnessOf([&](int u, int) { return stairs(u); }),
                             RoughnessOf([&](int, int v) { return stairs(v); })}) {
    EXPECT_GT(r.coarse, 2.0);
    EXPECT_GT(r.coarse, 1.5 * r.fine);  // one of eight neighbours is on the next step
  }
}

// A sensor bends by the angle. A small image shows the same bend in fewer pixels, and is no
// rougher for it; compared 8 pixels apart it would be three times as rough.
TEST(Roughness, OfABentPlaneDoesNotDependOnTheSizeOfTheImage) {
  const auto coarse = [](double scale) {
    Camera camera;
    camera.width = static_cast<int>(scale * camera.width);
    camera.height = static_cast<int>(scale * camera.height);
    camera.fx *= scale, camera.fy *= scale, camera.cx *= scale, camera.cy *= scale;
    cv::Mat1f depth_m(camera.height, camera.width);
    for (int v = 0; v < camera.height; ++v) {
      for (int u = 0; u < camera.width; ++u) {
        const Eigen::Vector3d ray = camera.Backproject({u, v}, 1.0);
        const double bend_m = 0.004 * std::sin(ray.x() / 0.02) * std::sin(ray.y() / 0.02);
        depth_m(v, u) =
            static_cast<float>(1.0 / kSlant.InverseDepth(ray.x(), ray.y()) + bend_m);
      }
    }
    const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
    const cv::Rect whole(0, 0, camera.width, camera.height);
    return MeasureRoughness(grid, cv::Mat1b(whole.size(), 3), whole, 3, kSlant, {}, 1).coarse;
  };
  const double full = coarse(1.0);
  EXPECT_GT(full, 0.1);  // there is something to be seen
  EXPECT_NEAR(coarse(0.5), full, 0.05 * full);
  EXPECT_NEAR(coarse(0.75), full, 0.1 * full);  // 6 pixels
}

/// The same pair by pair.
double PairByPair(const DepthGrid& grid, const cv::Mat1b& labels, const cv::Rect& bounds,
                  int step_px, int apart_px) {
  const PixelPlane plane(LabelPlane{kSlant, 1.0});
  double sum = 0.0;
  int pairs = 0;
  for (int v = bounds.y; v < bounds.br().y; v += step_px) {
    for (int u = bounds.x; u < bounds.br().x; u += step_px) {
      for (const cv::Point& other : {cv::Point(u + apart_px, v), cv::Point(u, v + apart_px)}) {
        if (other.x >= labels.cols || other.y >= labels.rows) continue;
        if (labels(v, u) != 3 || labels(other) != 3) continue;
        const double by =
            static_cast<double>(
                ResidualSigmas(grid, static_cast<std::size_t>(grid.Index(u, v)), plane)) -
            static_cast<double>(ResidualSigmas(
                grid, static_cast<std::size_t>(grid.Index(other.x, other.y)), plane));
        sum += by * by, ++pairs;
      }
    }
  }
  const auto middle = static_cast<std::size_t>(
      grid.Index(bounds.x + bounds.width / 2, bounds.y + bounds.height / 2));
  const double x = static_cast<double>(grid.x[middle]), y = static_cast<double>(grid.y[middle]);
  const double grazing =
      DepthNoise{}.GrazingFactor(1.0 / kSlant.InverseDepth(x, y), kSlant.Cosine(x, y));
  return pairs < 30 ? 0.0 : sum / (2.0 * pairs * grazing * grazing);
}

TEST(Roughness, CountsEveryPairOnceToTheImagesBorders) {
  const int width = 90, height = 61;
  Camera camera;
  camera.width = width, camera.height = height;
  cv::Mat1f depth_m(height, width);
  cv::Mat1b labels(height, width);
  Random random{5};
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      depth_m(v, u) = static_cast<float>(0.9 + 0.02 * random.Uniform());
      labels(v, u) = random.Below(10) == 0 || (u + v) % 40 < 9 ? 0 : 3;
    }
  }
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(camera), {}, 10.0);
  for (const cv::Rect& bounds : {cv::Rect(0, 0, width, height), cv::Rect(3, 2, 71, 40),
                                 cv::Rect(70, 20, 20, 41), cv::Rect(37, 0, 45, 59)}) {
    cv::Mat1b own(height, width, static_cast<unsigned char>(0));
    labels(bounds).copyTo(own(bounds));
    for (const int step_px : {1, 2, 3, 5, 8, 13}) {
      const Roughness found = MeasureRoughness(grid, own, bounds, 3, kSlant, {}, step_px);
      const double fine = PairByPair(grid, own, bounds, step_px, 1);
      const double coarse = PairByPair(grid, own, bounds, step_px, 8);
      EXPECT_NEAR(found.fine, fine, 1e-5 * fine) << bounds << ", every " << step_px;
      EXPECT_NEAR(found.coarse, coarse, 1e-5 * coarse) << bounds << ", every " << step_px;
    }
  }
}

TEST(Roughness, OfAHandfulOfPixelsIsUnknown) {
  cv::Mat1f depth_m(480, 640);
  Random random{6};
  for (float& z : depth_m) z = static_cast<float>(1.0 + 0.02 * random.Uniform());
  const DepthGrid grid = MakeDepthGrid(depth_m, PixelRays(Camera{}), {}, 10.0);
  const auto of = [&](int side_px) {
    cv::Mat1b labels(480, 640, static_cast<unsigned char>(0));
    const cv::Rect bounds(0, 0, side_px, side_px);
    labels(bounds) = 1;
    return MeasureRoughness(grid, labels, bounds, 1, {0, 0, 1}, {}, 2);
  };
  EXPECT_EQ(of(7).fine, 0.0);     // 4 x 3 pairs either way
  EXPECT_GT(of(9).fine, 0.0);     // 5 x 4
  EXPECT_EQ(of(9).coarse, 0.0);   // 5 either way
  EXPECT_GT(of(14).coarse, 0.0);  // 7 x 3
}

}  // namespace
}  // namespace slam
