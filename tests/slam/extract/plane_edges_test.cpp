#include "slam/extract/plane_edges.h"

#include <gtest/gtest.h>

#include <map>

#include "slam/extract/plane_segments.h"
#include "tests/support/closed_form_depth.h"

namespace slam {
namespace {

/// A horizontal plate seen from above at 1 m, fronto-parallel, over a floor 1.2 m below it.
struct PlateView {
  explicit PlateView(closed_form::World extra = {}) {
    world.boxes = {{{0, 0, 0}, {0.4, 0.3, 0.02}, 0.0, ""},
                   {{0, 0, -1.2}, {9, 9, 0.02}, 0.0, ""}};
    world.boxes.insert(world.boxes.end(), extra.boxes.begin(), extra.boxes.end());
    view = closed_form::Render(world, camera, closed_form::LookAt({0, 0, 1.01}, {0, 0, 0}));
  }
  /// Edge points of the plate by kind.
  std::map<EdgeKind, int> Kinds(const cv::Mat1f& depth_m) {
    frame = closed_form::MakeFrame(depth_m);
    ExtractPlanes(frame, camera, PixelRays(camera), {});
    std::map<EdgeKind, int> kinds;
    for (const FramePlane& plane : frame.planes) {
      if (std::abs(plane.pi_c.d - 1.0) > 0.01) continue;
      for (const EdgePoint& e : plane.edge_points) ++kinds[e.kind];
    }
    return kinds;
  }
  Camera camera;
  closed_form::World world;
  closed_form::View view;
  Frame frame;
};

TEST(PlaneEdges, AreTheSurfacesOwnWhereAStepGoesDown) {
  PlateView plate;
  const auto kinds = plate.Kinds(plate.view.depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kSurface), 1u);
  EXPECT_EQ(kinds.size(), 1u);
  // Perimeter 2 (210 + 157.5) px, every second pixel.
  EXPECT_NEAR(kinds.at(EdgeKind::kSurface), 367, 15);
}

TEST(PlaneEdges, AreOccludedWhereSomethingNearerHidesTheRest) {
  PlateView plate({{{{0.15, 0.0, 0.3}, {0.1, 0.6, 0.02}, 0.0, ""}}});
  const auto kinds = plate.Kinds(plate.view.depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kOccluded), 1u);
  EXPECT_NEAR(kinds.at(EdgeKind::kOccluded), 157 / 2, 6);  // one short side
}

TEST(PlaneEdges, AreMissingWhereNothingIsMeasured) {
  PlateView plate;
  cv::Mat1f depth_m = plate.view.depth_m.clone();
  depth_m.colRange(0, 320).setTo(0.0f);
  const auto kinds = plate.Kinds(depth_m);
  ASSERT_EQ(kinds.count(EdgeKind::kMissing), 1u);
  EXPECT_NEAR(kinds.at(EdgeKind::kMissing), 157 / 2, 6);
}

TEST(PlaneEdges, AreTheBorderWhereTheImageEnds) {
  PlateView plate;
  Frame frame;
  Camera camera = plate.camera;
  camera.width = 320;  // the left half of the image
  frame = closed_form::MakeFrame(plate.view.depth_m.colRange(0, 320).clone());
  ExtractPlanes(frame, camera, PixelRays(camera), {});
  int border = 0;
  for (const FramePlane& plane : frame.planes) {
    if (std::abs(plane.pi_c.d - 1.0) > 0.01) continue;
    for (const EdgePoint& e : plane.edge_points) border += e.kind == EdgeKind::kBorder ? 1 : 0;
  }
  EXPECT_NEAR(border, 157 / 2, 6);
}

TEST(PlaneEdges, AreTheSurfacesOwnAtAConcaveCrease) {
  // A desk meets a wall: the desk ends there, nothing hides it.
  closed_form::World world = closed_form::Desk();
  world.boxes.push_back({{0, 0.3, 0.5}, {3.0, 0.2, 1.0}, 0.0, ""});
  const Camera camera;
  const closed_form::View view =
      closed_form::Render(world, camera, closed_form::LookAt({0, -0.6, 0.6}, {0, 0.1, 0}));
  Frame frame = closed_form::MakeFrame(view.depth_m);
  ExtractPlanes(frame, camera, PixelRays(camera), {});
  int occluded = 0, surface = 0;
  for (const EdgePoint& e : frame.planes.at(0).edge_points) {
    occluded += e.kind == EdgeKind::kOccluded ? 1 : 0;
    surface += e.kind == EdgeKind::kSurface ? 1 : 0;
  }
  EXPECT_GT(surface, 20);
  EXPECT_LT(occluded, surface / 10);
}

}  // namespace
}  // namespace slam
