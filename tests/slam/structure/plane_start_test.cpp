#include "slam/structure/plane_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "slam/base/degrees.h"

namespace slam {
namespace {

constexpr double kImage_px = 640 * 480;
constexpr int kLarge_px = 4800;  // a 64th

/// A top that faces the camera.
FramePlane Top(int pixels) {
  FramePlane plane;
  plane.pi_c = {Eigen::Vector3d(0, 0, -1), 1.0};
  plane.centroid_c = {0, 0, 1.0};
  plane.pixel_count = pixels;
  return plane;
}

/// An edge that runs at this angle and has the middle to its left; half a turn more is the one opposite.
FramePlane WithEdge(FramePlane plane, double angle_deg) {
  const double angle_rad = RadiansOf(angle_deg);
  const Eigen::Vector3d along(std::cos(angle_rad), std::sin(angle_rad), 0.0);
  const Eigen::Vector3d outwards(along.y(), -along.x(), 0.0);
  plane.lines_c.push_back({plane.centroid_c + 0.1 * outwards, along});
  return plane;
}

FramePlane Wall(int pixels, double angle_deg) {
  FramePlane plane = Top(pixels);
  const double angle_rad = RadiansOf(angle_deg);
  plane.pi_c.n = -Eigen::Vector3d(std::sin(angle_rad), 0.0, std::cos(angle_rad));
  return plane;
}

bool CanStart(const std::vector<FramePlane>& planes, bool edges_alone = true) {
  StructureConfig config;
  config.edges_alone = edges_alone;
  return PlanesCanStart(planes, kImage_px, config);
}

TEST(PlanesCanStart, WithTwoLargeFacesFarFromParallel) {
  EXPECT_TRUE(CanStart({Top(kLarge_px), Wall(kLarge_px, 30)}, false));
  EXPECT_FALSE(CanStart({Top(kLarge_px), Wall(kLarge_px, 20)}));
  EXPECT_FALSE(CanStart({Top(kLarge_px), Wall(kLarge_px - 1, 30)}));
  EXPECT_FALSE(CanStart({Top(kLarge_px), Top(kLarge_px)}));
  EXPECT_FALSE(CanStart({}));
}

TEST(PlanesCanStart, WithTwoEdgesOfLargeFacesFarFromParallel) {
  EXPECT_TRUE(CanStart({WithEdge(WithEdge(Top(kLarge_px), 0), 30)}));
  EXPECT_TRUE(CanStart({WithEdge(Top(kLarge_px), 10), WithEdge(Top(kLarge_px), -80)}));
  EXPECT_FALSE(CanStart({WithEdge(WithEdge(Top(kLarge_px), 0), 20)}));
  EXPECT_FALSE(CanStart({WithEdge(WithEdge(Top(kLarge_px), 0), 180)}));
  EXPECT_FALSE(CanStart({WithEdge(Top(kLarge_px), 90)}));
  EXPECT_FALSE(CanStart({WithEdge(WithEdge(Top(kLarge_px - 1), 0), 90)}));
}

TEST(PlanesCanStart, WithEdgesOnlyWhereTheseMayHoldAPose) {
  EXPECT_FALSE(CanStart({WithEdge(WithEdge(Top(kLarge_px), 0), 90)}, false));
}

TEST(PlanesCanStart, WithoutPlanesThatAreNotTrusted) {
  FramePlane bad = WithEdge(WithEdge(Top(kLarge_px), 0), 90);
  bad.bad = BadReason::kInliers;
  EXPECT_FALSE(CanStart({bad}));
  EXPECT_FALSE(CanStart({bad, Wall(kLarge_px, 90)}));
}

}  // namespace
}  // namespace slam
